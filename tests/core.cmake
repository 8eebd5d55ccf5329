foreach(unit config parallel stage_times
             geometry/beam_image geometry/map_points geometry/neighbor_grid geometry/pose geometry/principal_axes geometry/project_kernel
             geometry/range_image geometry/voxel geometry/voxel_index geometry/voxel_neighbors
             front_end/front_end front_end/removert front_end/reverting front_end/submap front_end/visibility_removal
             front_end/window
             back_end/back_end back_end/contact back_end/evidence back_end/evidence_map
             back_end/line_of_sight back_end/sight_kernel back_end/normals back_end/occupancy back_end/submap_buffer
             back_end/visibility_check
             pipeline/dynamic_filter pipeline/merge pipeline/odd_scans pipeline/online_filter pipeline/pose_jump pipeline/scan_queue)
  df_test(${unit} dynamic_filter)
endforeach()

# Private to the library: the queue, the kernels, and the word on which of these exist.
target_include_directories(pipeline_scan_queue_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
foreach(kernel geometry_map_points_test geometry_project_kernel_test back_end_sight_kernel_test)
  target_include_directories(${kernel} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_definitions(${kernel} PRIVATE DYNAMIC_FILTER_X86_LEVELS)
  endif()
endforeach()
