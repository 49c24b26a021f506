# tarn floors, end to end.
tarn_test(floors_command LABEL gpu LIBRARIES nlohmann_json::nlohmann_json)
add_dependencies(test_floors_command tarn tarn_scenes)
