# What is checked of recordings and drives is tried on simulated ones.
df_room(io LIBRARIES dynamic_filter_app dynamic_filter_sim PNG::PNG SHARED Check Stamps)

add_executable(io_read_back_samples ${CMAKE_CURRENT_LIST_DIR}/read_back_samples.cpp)
target_link_libraries(io_read_back_samples PRIVATE dynamic_filter_io dynamic_filter_flags)
add_test(NAME io/read_back
         COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/read_back.py
                 $<TARGET_FILE:io_read_back_samples>)
set_tests_properties(io/read_back PROPERTIES SKIP_RETURN_CODE 77 LABELS io)
