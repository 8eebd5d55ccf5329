foreach(unit bag bag_writer benchmark cloud file frame frame_tree layout lzf matching messages
             natural_order pcd pcd_header ply ply_header png pose_table poses records rigid rosbag2
             sequence text trajectory writers)
  df_test(io/${unit} dynamic_filter_io)
  # Units behind the public headers are tested too.
  target_include_directories(io_${unit}_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
endforeach()
target_link_libraries(io_png_test PRIVATE PNG::PNG)
