# tarn study, end to end.
tarn_test(study_commands LABEL gpu LIBRARIES tarn_image_io nlohmann_json::nlohmann_json)
add_dependencies(test_study_commands tarn tarn_scenes)
