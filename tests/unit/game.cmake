# The game's own logic, which needs no window.
tarn_test(fly_camera LABEL unit LIBRARIES tarn_game)
tarn_test(rest_watch LABEL unit LIBRARIES tarn_game)
tarn_test(recent_timings LABEL unit LIBRARIES tarn_game)

# The game stands on the engine's public surface alone.
add_test(NAME tools.game COMMAND python3 ${PROJECT_SOURCE_DIR}/tests/tools/game_test.py ${CMAKE_CXX_COMPILER}
         $<JOIN:$<TARGET_PROPERTY:tarn_game,INCLUDE_DIRECTORIES>,:>)
set_tests_properties(tools.game PROPERTIES LABELS unit TIMEOUT 60)
