foreach(unit bag/bag bag/chunked_file bag/mcap_writer bag/rosbag2_writer bag/bag_writers bag/decompress bag/mcap bag/rosbag1 bag/rosbag1_writer bag/rosbag2 bag_scans
             benchmark byte_writer cloud cloud_writers drives/common_offset drives/drive_findings drives/meeting_places
             drives/place_offset field_types file folders frame las layout layouts/apollo
             layouts/argoverse layouts/below layouts/bin_points layouts/drive layouts/glim layouts/kitti_360
             layouts/kitti_raw layouts/matrix layouts/mulran layouts/numbers layouts/nuscenes layouts/pairs
             layouts/pose_notes layouts/several lzf matching motion/pose_mistakes natural_order npy pcd pcd_header
             pcd_writer ply ply_header png pose_fix pose_table pose_writers poses preflight/overlay preflight/samples
             records rigid ros/definitions ros/frame_tree ros/messages ros/packets ros/write_messages sequence text
             text_cloud trajectory writers)
  df_test(io/${unit} dynamic_filter_io)
  # Units behind the public headers are tested too.
  string(REPLACE "/" "_" name ${unit})
  target_include_directories(io_${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/src)
endforeach()
target_link_libraries(io_png_test PRIVATE PNG::PNG)

add_executable(io_read_back_samples ${CMAKE_CURRENT_LIST_DIR}/read_back_samples.cpp)
target_link_libraries(io_read_back_samples PRIVATE dynamic_filter_io dynamic_filter_flags)
add_dependencies(sanitized_tests io_read_back_samples)
add_test(NAME io/read_back
         COMMAND ${DF_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/read_back.py
                 $<TARGET_FILE:io_read_back_samples>)
set_tests_properties(io/read_back PROPERTIES SKIP_RETURN_CODE 77)

df_test(io/preflight/preflight dynamic_filter_app)  # on copies of a simulated recording
df_test(io/drives/compare_drives dynamic_filter_app)  # on parts of simulated recordings
df_test(io/motion/recorded_motion dynamic_filter_io dynamic_filter_sim)  # its scans are simulated
