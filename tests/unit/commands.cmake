# The command line as a person meets it.
tarn_test(commands LABEL unit LIBRARIES tarn_image_io nlohmann_json::nlohmann_json)
add_dependencies(test_commands tarn tarn_scenes)
