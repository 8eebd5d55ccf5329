# The readers' fuzz targets: replayed on the corpus by every build, run by script/fuzz.
add_library(dynamic_filter_fuzz STATIC ${CMAKE_CURRENT_LIST_DIR}/targets.cpp)
target_include_directories(dynamic_filter_fuzz PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..
  PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(dynamic_filter_fuzz PUBLIC dynamic_filter_app PRIVATE dynamic_filter_flags)

foreach(unit allocation corpus)
  df_test(fuzz/${unit} dynamic_filter_fuzz)
  target_compile_definitions(fuzz_${unit}_test PRIVATE
    DYNAMIC_FILTER_CORPUS="${CMAKE_CURRENT_LIST_DIR}/corpus")
endforeach()
target_sources(fuzz_allocation_test PRIVATE ${CMAKE_CURRENT_LIST_DIR}/failing_new.cpp)

if(DYNAMIC_FILTER_FUZZ)
  foreach(target bin calib config labels las mcap message npy pcd ply poses rosbag1 rosbag2 text)
    add_executable(fuzz_${target} ${CMAKE_CURRENT_LIST_DIR}/fuzzer.cpp)
    target_compile_definitions(fuzz_${target} PRIVATE DYNAMIC_FILTER_TARGET="${target}")
    target_link_libraries(fuzz_${target} PRIVATE dynamic_filter_fuzz dynamic_filter_flags)
    target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
  endforeach()
endif()
