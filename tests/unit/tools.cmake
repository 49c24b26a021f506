# The two commands, with stand-ins for the programs that they start.
add_test(NAME tools.setup COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/setup_test.sh)
set_tests_properties(tools.setup PROPERTIES LABELS unit TIMEOUT 60)
