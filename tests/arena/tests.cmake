df_room(arena LIBRARIES dynamic_filter_app)
if(DYNAMIC_FILTER_SIMULATOR)
  add_test(NAME arena/bench COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/bench_test.py $<TARGET_FILE:dynamicfilter>)
  add_test(NAME arena/count_on_twins COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/count_on_twins.py $<TARGET_FILE:dynamicfilter>)
endif()
add_test(NAME arena/independent_count COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/independent_count.py
  $<TARGET_FILE:dynamicfilter>)
