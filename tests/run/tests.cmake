df_room(run LIBRARIES dynamic_filter_app EXCEPT mpi/ SHARED Plugin TrialRun)  # of one file beside the program; on a simulated recording
add_test(NAME run/city COMMAND ${CMAKE_CURRENT_LIST_DIR}/city_test.sh $<TARGET_FILE:dynamicfilter>)
add_test(NAME run/kill COMMAND ${CMAKE_CURRENT_LIST_DIR}/kill_test.sh $<TARGET_FILE:dynamicfilter> 4)
set(slurm ${PROJECT_SOURCE_DIR}/packaging/slurm/dynamicfilter-slurm)
add_test(NAME run/slurm_options COMMAND ${CMAKE_CURRENT_LIST_DIR}/slurm_options_test.sh ${slurm})
add_test(NAME run/slurm COMMAND ${CMAKE_CURRENT_LIST_DIR}/slurm_test.sh $<TARGET_FILE:dynamicfilter> ${slurm})
add_test(NAME run/make COMMAND ${CMAKE_CURRENT_LIST_DIR}/make_test.sh $<TARGET_FILE:dynamicfilter>
  ${PROJECT_SOURCE_DIR}/packaging/make/dynamicfilter.mk)
set_tests_properties(run/slurm run/make PROPERTIES LABELS slow)
# Open MPI keeps memory until the end of the process, which the sanitizers report.
if(TARGET dynamicfilter_mpi AND NOT CMAKE_BUILD_TYPE STREQUAL Sanitize)
  add_executable(mpi_rank ${CMAKE_CURRENT_LIST_DIR}/mpi/mpi_rank.cpp)
  target_link_libraries(mpi_rank PRIVATE dynamic_filter_app dynamic_filter_flags)
  set_target_properties(mpi_rank PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})  # the plug-in is there
  df_room(run/mpi LIBRARIES fmt::fmt)
  target_compile_definitions(run_mpi_test PRIVATE MPI_RANK="$<TARGET_FILE:mpi_rank>")
  add_dependencies(run_mpi_test mpi_rank dynamicfilter_mpi)
  add_test(NAME run/mpi COMMAND ${CMAKE_CURRENT_LIST_DIR}/mpi_test.sh $<TARGET_FILE:dynamicfilter>)
  set_tests_properties(run/mpi PROPERTIES LABELS slow)
endif()
