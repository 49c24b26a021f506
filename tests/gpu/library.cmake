# The public surface of the library, in a context of its own and in somebody else's.
tarn_test(library LABEL gpu LIBRARIES tarn_api)
tarn_test(library_in_host LABEL gpu LIBRARIES tarn_api tarn_platform PkgConfig::EGL)
add_dependencies(test_library tarn tarn_scenes)
add_dependencies(test_library_in_host tarn_scenes)
