# The same seed gives the same bits, whatever the context and the threads. A window gets a display of its own.
tarn_test(determinism LABEL gpu LIBRARIES tarn_image_io tarn_rays tarn_world tarn_scene nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(test_determinism PRIVATE TARN_WITH_DISPLAY="${WITH_DISPLAY}")
add_dependencies(test_determinism tarn tarn_scenes)
