# The benchmark's analysis, on stand-ins whose error and time are known.
tarn_test(seed_statistics LABEL unit LIBRARIES tarn_metrics)
tarn_test(bench_methods LABEL unit LIBRARIES tarn_bench)
tarn_test(bench_protocol LABEL unit LIBRARIES tarn_bench tarn_image_io)
tarn_test(reference_cache LABEL unit LIBRARIES tarn_bench tarn_image_io)
tarn_test(report_page LABEL unit LIBRARIES tarn_bench tarn_image_io)
tarn_test(compare_results LABEL unit LIBRARIES tarn_bench tarn_image_io)
