add_test(NAME package/contents COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh
         ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/tests/package ${PROJECT_VERSION} "${CMAKE_CXX_COMPILER_LAUNCHER}")
set_tests_properties(package/contents PROPERTIES LABELS slow)
