# The two commands, with stand-ins for the programs that they start.
add_test(NAME tools.setup COMMAND bash ${PROJECT_SOURCE_DIR}/tests/tools/setup_test.sh)
set_tests_properties(tools.setup PROPERTIES LABELS unit TIMEOUT 60)

# Links and lengths of the documentation.
add_test(NAME tools.docs COMMAND python3 ${PROJECT_SOURCE_DIR}/tests/tools/docs_test.py)
set_tests_properties(tools.docs PROPERTIES LABELS unit TIMEOUT 60 SKIP_RETURN_CODE 77)

# Where the program finds its shaders, scenes and pages.
tarn_test(data_files LABEL unit LIBRARIES tarn_core)
