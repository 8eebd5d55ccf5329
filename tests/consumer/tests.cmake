add_test(NAME consumer/installed
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
                 "${CMAKE_CXX_COMPILER_LAUNCHER}" "${CMAKE_CXX_FLAGS}")
set_tests_properties(consumer/installed PROPERTIES LABELS slow)
