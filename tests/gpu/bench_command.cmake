# tarn bench, end to end.
tarn_test(bench_command LABEL gpu LIBRARIES tarn_image_io nlohmann_json::nlohmann_json)
add_dependencies(test_bench_command tarn tarn_scenes)
