tarn_test(raster_against_rays LABEL gpu TIMEOUT 600
          LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world tarn_core)
tarn_test(history LABEL gpu LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world tarn_core)
tarn_test(shared_world LABEL gpu LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world tarn_core)
