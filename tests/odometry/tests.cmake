foreach(unit coarse_search motion odometry overlay_blur registration scan_sample surface_map sweep_times)
  df_test(odometry/${unit} dynamic_filter)
endforeach()
target_include_directories(odometry_scan_sample_test PRIVATE ${PROJECT_SOURCE_DIR}/src)  # private to the library
