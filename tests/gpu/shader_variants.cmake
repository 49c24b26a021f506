# Every shader in every variant that a plan can ask for.
tarn_test(shader_variants LABEL gpu TIMEOUT 600 LIBRARIES tarn_passes tarn_platform)
