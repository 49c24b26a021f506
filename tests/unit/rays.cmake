# The ray tracers: Embree against the brute-force oracle.
tarn_test(rays LABEL unit LIBRARIES tarn_rays tarn_world TBB::tbb)
