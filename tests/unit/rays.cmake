# The ray tracers: Embree against the brute-force oracle, and both where textures decide what a ray meets.
tarn_test(rays LABEL unit LIBRARIES tarn_rays tarn_world TBB::tbb)
tarn_test(texture_slots LABEL unit LIBRARIES tarn_rays tarn_world)
tarn_test(previous_rays LABEL unit LIBRARIES tarn_rays tarn_world)
