# The two commands, with stand-ins for the programs that they start.
add_test(NAME tools.setup COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/setup_test.sh)
set_tests_properties(tools.setup PROPERTIES LABELS unit TIMEOUT 60)
# Where the program finds its shaders, scenes and pages.
tarn_test(data_files LABEL unit LIBRARIES tarn_core)
