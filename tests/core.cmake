# The core: each of its rooms is tested with the core alone.
df_room(core LIBRARIES dynamic_filter)
foreach(room geometry scans_observe submaps_observe pipeline odometry)
  df_room(${room} LIBRARIES dynamic_filter)
endforeach()

# Which of the kernels exist.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_definitions(geometry_test PRIVATE DYNAMIC_FILTER_X86_LEVELS)
  target_compile_definitions(scans_observe_test PRIVATE DYNAMIC_FILTER_X86_LEVELS)
endif()
