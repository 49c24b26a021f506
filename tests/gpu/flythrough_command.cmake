# tarn flythrough, end to end.
tarn_test(flythrough_command LABEL gpu LIBRARIES nlohmann_json::nlohmann_json)
add_dependencies(test_flythrough_command tarn tarn_scenes)
