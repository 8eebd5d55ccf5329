add_test(NAME package/contents
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh ${PROJECT_BINARY_DIR} ${PROJECT_VERSION})
set_tests_properties(package/contents PROPERTIES LABELS slow)
