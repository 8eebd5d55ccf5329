foreach(unit advice config_file edits label_store map_files output_folder progress protocols report stage_clock)
  df_test(apps/${unit} dynamic_filter_app)
endforeach()
foreach(unit http_request http_server live_feed page run_view thinned_cloud)
  df_test(apps/view/${unit} dynamic_filter_app)
endforeach()
df_test(apps/command dynamic_filter_app)
add_dependencies(apps_command_test dynamicfilter)
target_compile_definitions(apps_command_test PRIVATE COMMAND="$<TARGET_FILE:dynamicfilter>")

add_test(NAME apps/kill COMMAND ${CMAKE_CURRENT_LIST_DIR}/kill_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME apps/interrupt COMMAND ${CMAKE_CURRENT_LIST_DIR}/interrupt_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME apps/completion COMMAND ${CMAKE_CURRENT_LIST_DIR}/completion_test.sh $<TARGET_FILE:dynamicfilter>
  ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter.bash)

foreach(unit dds_bus foxglove_handshake foxglove_protocol foxglove_queue foxglove_server)
  df_test(apps/live/${unit} dynamic_filter_live)
endforeach()
