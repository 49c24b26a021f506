# The public surface of the library, in a context of its own and in somebody else's.
tarn_test(library LABEL gpu LIBRARIES tarn_api tarn_image_io)
tarn_test(library_views LABEL gpu LIBRARIES tarn_api tarn_image_io)
tarn_test(library_things LABEL gpu LIBRARIES tarn_api)
tarn_test(library_rest LABEL gpu LIBRARIES tarn_api tarn_image_io)
tarn_test(library_in_host LABEL gpu LIBRARIES tarn_api tarn_platform PkgConfig::EGL)
add_dependencies(test_library tarn tarn_scenes)
add_dependencies(test_library_in_host tarn_scenes)
# The same from outside: installed, found by a foreign project, and run from there.
add_test(NAME tools.library COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/library_test.sh ${PROJECT_BINARY_DIR} ${WITH_DISPLAY})
set_tests_properties(tools.library PROPERTIES LABELS tools TIMEOUT 300 COST 300)
