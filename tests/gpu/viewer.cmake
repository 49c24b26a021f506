# What the window shows: the display pass, the game's window, and the viewer in it with real events.
tarn_test(display_pass LABEL gpu LIBRARIES tarn_passes tarn_platform)
tarn_test(average_pass LABEL gpu LIBRARIES tarn_passes tarn_platform tarn_test_support)
tarn_test(exposure_pass LABEL gpu LIBRARIES tarn_passes tarn_platform tarn_test_support)
tarn_test(jitter LABEL gpu LIBRARIES tarn_renderer tarn_platform tarn_rays tarn_world)
tarn_test(game_window LABEL gpu LIBRARIES tarn_game)
if(WITH_DISPLAY)
  add_test(NAME game_window_in_xvfb COMMAND ${WITH_DISPLAY} $<TARGET_FILE:test_game_window>)
  set_tests_properties(game_window_in_xvfb PROPERTIES LABELS gpu TIMEOUT 300)
endif()

tarn_test(sandbox_files LABEL gpu LIBRARIES tarn_sandbox glfw)
add_dependencies(test_sandbox_files tarn_scenes tarn_noise_mask)
if(WITH_DISPLAY)
  add_test(NAME sandbox_files_in_xvfb COMMAND ${WITH_DISPLAY} $<TARGET_FILE:test_sandbox_files>)
  set_tests_properties(sandbox_files_in_xvfb PROPERTIES LABELS gpu TIMEOUT 300)
endif()

find_program(XDOTOOL xdotool)
find_program(IMPORT import)
if(WITH_DISPLAY AND XDOTOOL AND IMPORT)
  set(VIEWER_DISPLAY ${WITH_DISPLAY})
else()
  set(VIEWER_DISPLAY env TARN_SKIP_VIEWER=Xvfb,\ xdotool\ or\ imagemagick\ is\ missing)
endif()
add_test(NAME viewer_in_xvfb
         COMMAND ${VIEWER_DISPLAY} bash ${CMAKE_CURRENT_SOURCE_DIR}/viewer.sh $<TARGET_FILE:tarn>
                 ${PROJECT_BINARY_DIR}/content/cornell.glb ${PROJECT_BINARY_DIR}/viewer_test)
set_tests_properties(viewer_in_xvfb PROPERTIES LABELS gpu TIMEOUT 600 COST 600 SKIP_RETURN_CODE 77)
add_test(NAME sandbox_in_xvfb
         COMMAND ${VIEWER_DISPLAY} bash ${CMAKE_CURRENT_SOURCE_DIR}/sandbox.sh $<TARGET_FILE:tarn-sandbox>
                 ${PROJECT_BINARY_DIR}/sandbox_test)
set_tests_properties(sandbox_in_xvfb PROPERTIES LABELS gpu TIMEOUT 600 COST 600 SKIP_RETURN_CODE 77)

# A replay without a window: the same pictures each time.
tarn_test(sandbox_replay LABEL gpu LIBRARIES tarn_play)
target_compile_definitions(test_sandbox_replay PRIVATE TARN_WITH_DISPLAY="${WITH_DISPLAY}")
add_dependencies(test_sandbox_replay tarn-sandbox tarn_scenes)
