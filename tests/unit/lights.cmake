# The table of lights as it is made, as the scene moves and is edited, how readers follow it, and the tree over it.
tarn_test(change_log LABEL unit LIBRARIES tarn_world)
tarn_test(light_sources LABEL unit LIBRARIES tarn_world)
tarn_test(light_updates LABEL unit LIBRARIES tarn_world)
tarn_test(light_tree LABEL unit LIBRARIES tarn_world)
tarn_test(light_tree_odd_tables LABEL unit LIBRARIES tarn_world)
tarn_test(light_tree_bounds LABEL unit LIBRARIES tarn_world TBB::tbb)
