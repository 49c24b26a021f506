# tarn render and tarn flythrough as a person meets them.
tarn_test(render_commands LABEL gpu LIBRARIES tarn_image_io nlohmann_json::nlohmann_json)
add_dependencies(test_render_commands tarn tarn_scenes)
