# The table of lights as the scene moves and is edited.
tarn_test(light_updates LABEL unit LIBRARIES tarn_world)
