add_test(NAME package/contents COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh
         ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/tests/package ${PROJECT_VERSION} "${CMAKE_CXX_COMPILER_LAUNCHER}")
set_tests_properties(package/contents PROPERTIES LABELS slow)
add_test(NAME package/left_out COMMAND ${CMAKE_CURRENT_LIST_DIR}/left_out_test.sh
         ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} "${CMAKE_CXX_COMPILER_LAUNCHER}")
set_tests_properties(package/left_out PROPERTIES LABELS slow)
