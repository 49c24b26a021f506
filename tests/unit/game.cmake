# The sandbox's own logic: the fly camera.
tarn_test(fly_camera LABEL unit LIBRARIES tarn_game)
