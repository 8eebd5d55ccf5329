add_test(NAME consumer/headers
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/headers.py ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR})
add_test(NAME consumer/installed
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
                 "${CMAKE_CXX_COMPILER_LAUNCHER}" "${CMAKE_CXX_FLAGS}")
set_tests_properties(consumer/installed PROPERTIES LABELS slow)
add_test(NAME consumer/readme COMMAND ${CMAKE_CURRENT_LIST_DIR}/readme.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
set_tests_properties(consumer/readme PROPERTIES LABELS slow)
