# Shared functions on the GL side against the same text compiled as C++.
tarn_test(kernels LABEL gpu LIBRARIES tarn_platform tarn_shared)
