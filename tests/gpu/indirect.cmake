# Indirect light on a coarse picture.
tarn_test(coarse_picture LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(coarse_rays LABEL gpu LIBRARIES tarn_passes tarn_platform)
