# The game's own logic, which needs no window.
tarn_test(fly_camera LABEL unit LIBRARIES tarn_game)
tarn_test(rest_watch LABEL unit LIBRARIES tarn_game)
tarn_test(recent_timings LABEL unit LIBRARIES tarn_game)

# The game stands on the engine's public surface alone.
add_test(NAME tools.game COMMAND python3 ${PROJECT_SOURCE_DIR}/tests/tools/game_test.py ${CMAKE_CXX_COMPILER}
         $<JOIN:$<TARGET_PROPERTY:tarn_game,INCLUDE_DIRECTORIES>,:>:$<JOIN:$<TARGET_PROPERTY:tarn_play,INCLUDE_DIRECTORIES>,:>)
set_tests_properties(tools.game PROPERTIES LABELS unit TIMEOUT 60)

# What happens in the sandbox.
tarn_test(play_character LABEL unit LIBRARIES tarn_play)
tarn_test(play_balls LABEL unit LIBRARIES tarn_play)
tarn_test(gamepad LABEL unit LIBRARIES tarn_sandbox)
tarn_test(governor LABEL unit LIBRARIES tarn_sandbox)
tarn_test(saves LABEL unit LIBRARIES tarn_sandbox fmt::fmt)
tarn_test(key_map LABEL unit LIBRARIES tarn_sandbox glfw)
tarn_test(help LABEL unit LIBRARIES tarn_sandbox imgui_imgui)
tarn_test(firefly_lamps LABEL unit LIBRARIES tarn_sandbox)
tarn_test(play_crates LABEL unit LIBRARIES tarn_play)
tarn_test(play_court LABEL unit LIBRARIES tarn_play)
tarn_test(play_fireflies LABEL unit LIBRARIES tarn_play)
tarn_test(play_save LABEL unit LIBRARIES tarn_play fmt::fmt)
tarn_test(simulation LABEL unit LIBRARIES tarn_play)
tarn_test(replay_file LABEL unit LIBRARIES tarn_play)
add_dependencies(test_simulation tarn_scenes)
add_dependencies(test_play_crates tarn_scenes)
add_dependencies(test_play_court tarn_scenes)
add_dependencies(test_play_fireflies tarn_scenes)
add_dependencies(test_firefly_lamps tarn_scenes)
add_dependencies(test_saves tarn_scenes)
