df_room(commands LIBRARIES dynamic_filter_app)
add_dependencies(commands_test dynamicfilter)
target_compile_definitions(commands_test PRIVATE COMMAND="$<TARGET_FILE:dynamicfilter>")
# Each case starts the command several times, which takes the sanitizers ten minutes in all; they run a quarter of the cases.
if(CMAKE_BUILD_TYPE STREQUAL Sanitize)
  set_tests_properties(commands/commands_test PROPERTIES ENVIRONMENT "GTEST_TOTAL_SHARDS=4;GTEST_SHARD_INDEX=0")
endif()
add_test(NAME commands/kill COMMAND ${CMAKE_CURRENT_LIST_DIR}/kill_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME commands/interrupt COMMAND ${CMAKE_CURRENT_LIST_DIR}/interrupt_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME commands/completion COMMAND ${CMAKE_CURRENT_LIST_DIR}/completion_test.sh $<TARGET_FILE:dynamicfilter>
  ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter.bash)
