df_room(base LIBRARIES dynamic_filter_io EXCEPT parallel)
# A program of its own, because it needs the core alone: script/sanitize builds it with the thread sanitizer.
df_test_program(parallel_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/parallel_test.cpp LIBRARIES dynamic_filter)
df_list_cases(parallel_test base)
