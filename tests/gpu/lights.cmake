# The light tree on the GL side against the same text compiled as C++.
tarn_test(light_tree_kernel LABEL gpu LIBRARIES tarn_platform tarn_world)
tarn_test(light_lookup LABEL gpu LIBRARIES tarn_passes tarn_platform tarn_world)
