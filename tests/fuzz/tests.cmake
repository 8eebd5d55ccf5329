# The readers' fuzz targets: replayed on the corpus by every build, run by script/fuzz.
add_library(dynamic_filter_fuzz STATIC ${CMAKE_CURRENT_LIST_DIR}/targets.cpp)
target_include_directories(dynamic_filter_fuzz PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(dynamic_filter_fuzz PUBLIC dynamic_filter_app PRIVATE dynamic_filter_flags)

df_room(fuzz LIBRARIES dynamic_filter_fuzz EXCEPT allocation)
# Its memory runs out: it has an operator new of its own, which the compiler must not see beside its uses.
df_test_program(fuzz_allocation_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/allocation_test.cpp ${CMAKE_CURRENT_LIST_DIR}/failing_new.cpp
  LIBRARIES dynamic_filter_fuzz)
set_target_properties(fuzz_allocation_test PROPERTIES UNITY_BUILD OFF)
df_list_cases(fuzz_allocation_test fuzz)
foreach(program fuzz_test fuzz_allocation_test)
  target_compile_definitions(${program} PRIVATE
    DYNAMIC_FILTER_CORPUS="${CMAKE_CURRENT_LIST_DIR}/corpus")
endforeach()

if(DYNAMIC_FILTER_FUZZ)
  foreach(target bin calib config knowable labels las mask mcap message npy pcd ply poses rosbag1 rosbag2 text)
    add_executable(fuzz_${target} ${CMAKE_CURRENT_LIST_DIR}/fuzzer.cpp)
    target_compile_definitions(fuzz_${target} PRIVATE DYNAMIC_FILTER_TARGET="${target}")
    target_link_libraries(fuzz_${target} PRIVATE dynamic_filter_fuzz dynamic_filter_flags)
    target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
  endforeach()
endif()
