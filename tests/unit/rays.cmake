# The ray tracers: Embree against the brute-force oracle, both where textures decide what a ray meets, and when rays draw.
tarn_test(rays LABEL unit LIBRARIES tarn_rays tarn_world TBB::tbb)
tarn_test(camera_rays LABEL unit LIBRARIES tarn_rays tarn_world TBB::tbb)
tarn_test(primary_plan LABEL unit LIBRARIES tarn_plan)
tarn_test(texture_slots LABEL unit LIBRARIES tarn_rays tarn_world)
tarn_test(previous_rays LABEL unit LIBRARIES tarn_rays tarn_world)
