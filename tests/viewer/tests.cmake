# The viewer's page is driven in a browser, where there is one.
add_test(NAME viewer/page COMMAND ${CMAKE_CURRENT_LIST_DIR}/run.sh ${PROJECT_BINARY_DIR}/viewer.html)
set_tests_properties(viewer/page PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 RUN_SERIAL TRUE)
