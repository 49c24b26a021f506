# The blue noise mask: how it is made, what the build has made, its file, and the numbers that are read from it.
tarn_test(void_and_cluster LABEL unit LIBRARIES tarn_noise_maker)
tarn_test(blue_noise_mask LABEL unit LIBRARIES tarn_noise tarn_noise_maker)
tarn_test(blue_noise_file LABEL unit LIBRARIES tarn_noise)
tarn_test(blue_noise LABEL unit LIBRARIES tarn_noise)
