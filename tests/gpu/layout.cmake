# Records packed on one side and unpacked on the other.
tarn_test(layout LABEL gpu LIBRARIES tarn_platform tarn_world tarn_shared)
