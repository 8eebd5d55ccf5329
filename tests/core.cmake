foreach(unit config edit_distance keyframe map_contents parallel stage_times
             geometry/beam_image geometry/map_points geometry/neighbor_grid geometry/pose geometry/principal_axes geometry/project_kernel
             geometry/range_image geometry/voxel geometry/voxel_index geometry/voxel_kernel geometry/voxel_neighbors
             scans_observe/clusters scans_observe/contact scans_observe/final_map scans_observe/line_of_sight_scalar scans_observe/evidence scans_observe/evidence_grid scans_observe/evidence_map
             scans_observe/instances scans_observe/instant scans_observe/line_of_sight scans_observe/observers scans_observe/scans_method scans_observe/sight_kernel
             scans_observe/vote scans_observe/vote_kernel
             submaps_observe/back_end submaps_observe/front_end submaps_observe/merge submaps_observe/normals
             submaps_observe/occupancy submaps_observe/removert submaps_observe/reverting submaps_observe/submap
             submaps_observe/submap_buffer submaps_observe/submaps_method submaps_observe/visibility_check submaps_observe/visibility_removal
             submaps_observe/window
             pipeline/dynamic_filter pipeline/map_segments pipeline/odd_scans pipeline/online_filter pipeline/pose_jump
             pipeline/pose_tracker pipeline/scan_queue pipeline/two_stages)
  df_test(${unit} dynamic_filter)
endforeach()

# Private to the library: the stages of the filters, the kernels, and the word on which of these exist.
foreach(unit map_segments pose_tracker scan_queue two_stages)
  target_include_directories(pipeline_${unit}_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
endforeach()
foreach(kernel geometry_project_kernel_test geometry_voxel_kernel_test scans_observe_sight_kernel_test scans_observe_vote_kernel_test)
  target_include_directories(${kernel} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_definitions(${kernel} PRIVATE DYNAMIC_FILTER_X86_LEVELS)
  endif()
endforeach()
