df_room(upkeep LIBRARIES dynamic_filter_app)
if(DYNAMIC_FILTER_SIMULATOR)
  add_test(NAME upkeep/diff COMMAND ${CMAKE_CURRENT_LIST_DIR}/diff_test.sh $<TARGET_FILE:dynamicfilter> ${DF_PYTHON})
endif()
