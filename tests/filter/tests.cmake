df_room(filter LIBRARIES dynamic_filter)
# Which kernels exist.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_definitions(filter_test PRIVATE DYNAMIC_FILTER_X86_LEVELS)
endif()
