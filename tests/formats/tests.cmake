df_room(formats LIBRARIES dynamic_filter_io)

add_executable(read_back_samples ${CMAKE_CURRENT_LIST_DIR}/read_back_samples.cpp)
target_link_libraries(read_back_samples PRIVATE dynamic_filter_io dynamic_filter_flags)
add_test(NAME formats/read_back COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/read_back.py $<TARGET_FILE:read_back_samples>)
set_tests_properties(formats/read_back PROPERTIES SKIP_RETURN_CODE 77 LABELS formats)
