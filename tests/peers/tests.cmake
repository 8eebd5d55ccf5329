# What is written is read by others: npm's packages (script/bootstrap tests), Python's SQLite and
# numpy, Open3D (python3-open3d) and ROS 1 (python3-rosbag,
# python3-sensor-msgs). A peer that is not there is a test that says "Skipped".

foreach(writer write_bags write_clouds)
  add_executable(${writer} ${CMAKE_CURRENT_LIST_DIR}/${writer}.cpp)
  target_include_directories(${writer} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${writer} PRIVATE dynamic_filter_io dynamic_filter_flags fmt::fmt)
endforeach()

# df_peer(NAME WRITER EXTENSION INTERPRETER READER)
function(df_peer name writer extension interpreter reader)
  add_test(NAME peers/${name}
           COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/compare.sh $<TARGET_FILE:${writer}>
                   ${extension} ${interpreter} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${reader})
  set_tests_properties(peers/${name} PROPERTIES SKIP_RETURN_CODE 77)
endfunction()

df_peer(mcap write_bags mcap node read_bag.cjs)
df_peer(bag write_bags bag node read_bag.cjs)
df_peer(db3 write_bags db3 ${DF_PYTHON} read_db3.py)
df_peer(ros1/bag write_bags bag ${DF_PYTHON} read_rosbag.py)
df_peer(copc/las write_clouds las node read_cloud.mjs)
foreach(kind pcd ascii.pcd compressed.pcd ply)
  df_peer(three/${kind} write_clouds ${kind} node read_cloud.mjs)
  df_peer(open3d/${kind} write_clouds ${kind} ${DF_PYTHON} read_cloud.py)
endforeach()
foreach(kind npy bin)
  df_peer(numpy/${kind} write_clouds ${kind} ${DF_PYTHON} read_cloud.py)
endforeach()

add_executable(write_tileset ${CMAKE_CURRENT_LIST_DIR}/write_tileset.cpp)
target_include_directories(write_tileset PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(write_tileset PRIVATE dynamic_filter_app dynamic_filter_flags)
df_peer(three/3dtiles write_tileset 3dtiles node read_tileset.mjs)

if(NOT DYNAMIC_FILTER_LIVE)
  return()
endif()
add_executable(serve_foxglove ${CMAKE_CURRENT_LIST_DIR}/serve_foxglove.cpp)
target_include_directories(serve_foxglove PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(serve_foxglove PRIVATE dynamic_filter_live dynamic_filter_flags fmt::fmt)
foreach(encoding ros1 cdr)
  add_test(NAME peers/foxglove/${encoding}
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/foxglove.sh $<TARGET_FILE:serve_foxglove> ${encoding})
  set_tests_properties(peers/foxglove/${encoding} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
# Another implementation of DDS, for the tests of the live filter.
find_package(fastcdr REQUIRED)
find_package(fastdds QUIET)  # from version 3 on
if(fastdds_FOUND)
  set(fastdds fastdds)
else()
  find_package(fastrtps REQUIRED)
  set(fastdds fastrtps)
endif()
add_executable(fastdds_peer ${CMAKE_CURRENT_LIST_DIR}/fastdds_peer.cpp
  ${CMAKE_CURRENT_LIST_DIR}/fastdds_options.cpp ${CMAKE_CURRENT_LIST_DIR}/cdr_text.cpp)
target_include_directories(fastdds_peer PRIVATE ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(fastdds_peer PRIVATE ${fastdds} fastcdr dynamic_filter_flags)
# Fast DDS deletes objects with another size than they were made with, which sanitizers object to.
target_compile_options(fastdds_peer PRIVATE -fno-sanitize=all)
target_link_options(fastdds_peer PRIVATE -fno-sanitize=all)
