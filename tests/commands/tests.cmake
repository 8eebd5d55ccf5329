df_room(commands LIBRARIES dynamic_filter_app)
add_dependencies(commands_test dynamicfilter)
target_compile_definitions(commands_test PRIVATE COMMAND="$<TARGET_FILE:dynamicfilter>")
add_test(NAME commands/kill COMMAND ${CMAKE_CURRENT_LIST_DIR}/kill_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME commands/interrupt COMMAND ${CMAKE_CURRENT_LIST_DIR}/interrupt_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME commands/completion COMMAND ${CMAKE_CURRENT_LIST_DIR}/completion_test.sh $<TARGET_FILE:dynamicfilter>
  ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter.bash)
