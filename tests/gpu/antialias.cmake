# Antialiasing over time: its pass over surfaces and radiance written by hand, and in a renderer.
tarn_test(antialias_pass LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(antialias_motion LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(antialias_lamps LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(antialias LABEL gpu LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world tarn_core)
