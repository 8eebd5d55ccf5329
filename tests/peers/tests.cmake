# The bags written are read by others: node's packages (npm ci --ignore-scripts) and Python's SQLite.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_executable(write_bags ${CMAKE_CURRENT_LIST_DIR}/write_bags.cpp)
target_include_directories(write_bags PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(write_bags PRIVATE dynamic_filter_io dynamic_filter_flags fmt::fmt)
add_dependencies(tests_without_simulator write_bags)
foreach(kind mcap bag)
  add_test(NAME peers/${kind}
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/compare.sh $<TARGET_FILE:write_bags> ${kind}
                   node ${CMAKE_CURRENT_LIST_DIR}/read_bag.cjs)
  set_tests_properties(peers/${kind} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
add_test(NAME peers/db3
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/compare.sh $<TARGET_FILE:write_bags> db3
                 $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_LIST_DIR}/read_db3.py)
