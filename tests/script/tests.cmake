add_test(NAME script/headers
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/headers_test.py)
set_tests_properties(script/headers PROPERTIES SKIP_RETURN_CODE 77)
add_test(NAME script/mechanisms
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/mechanisms_test.py ${PROJECT_SOURCE_DIR} $<TARGET_FILE:dynamicfilter>)
add_test(NAME script/faults
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/faults_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME script/skips COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/skips_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME script/regions
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/regions_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME script/mirror COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/mirror_test.py)
add_test(NAME script/release COMMAND ${CMAKE_CURRENT_LIST_DIR}/release_test.sh ${PROJECT_SOURCE_DIR})
add_test(NAME script/versions COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/versions_test.py ${PROJECT_SOURCE_DIR})
