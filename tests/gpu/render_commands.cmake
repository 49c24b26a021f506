# tarn render and tarn flythrough as a person meets them.
tarn_test(render_commands LABEL gpu LIBRARIES tarn_image_io nlohmann_json::nlohmann_json)
add_dependencies(test_render_commands tarn tarn_scenes)
# The CI example, with this tarn.
add_test(NAME tools.render_and_compare
         COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/render_and_compare_test.sh ${PROJECT_BINARY_DIR})
set_tests_properties(tools.render_and_compare PROPERTIES LABELS gpu TIMEOUT 300)
