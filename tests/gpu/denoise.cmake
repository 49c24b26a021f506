# The denoiser: its passes over surfaces and light written by hand, and in a renderer whose lights change.
tarn_test(denoise_pass LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(denoise_changes LABEL gpu LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world tarn_core)
