# Single settings of direct light, each by what it must do.
tarn_test(direct_options LABEL gpu TIMEOUT 300 LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world)
