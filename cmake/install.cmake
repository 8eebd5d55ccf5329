# What is installed: the command (component `command`); the libraries, their headers and
# DynamicFilterConfig.cmake (`dev`); shared libraries (`library`), if BUILD_SHARED_LIBS is set; the
# Python package (`python`); the ROS 1 node (`ros`); the plug-ins for MPI (`mpi`) and
# for coordinate systems (`crs`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(DF_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/DynamicFilter)

install(DIRECTORY include/dynamic_filter COMPONENT dev DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

foreach(part io eval sim)
  set_target_properties(dynamic_filter_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()
# While the major version is 0, a minor version may also break the ABI. From 1.0 on, only the major
# version may.
set(DF_LIBRARIES dynamic_filter dynamic_filter_io dynamic_filter_eval dynamic_filter_sim)
set_target_properties(${DF_LIBRARIES} PROPERTIES
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(destinations LIBRARY COMPONENT library NAMELINK_COMPONENT dev ARCHIVE COMPONENT dev
                 INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# The simulator has its own export set, because only it needs Embree.
install(TARGETS dynamic_filter dynamic_filter_io dynamic_filter_eval EXPORT DynamicFilterTargets ${destinations})
install(TARGETS dynamic_filter_sim EXPORT DynamicFilterSimTargets ${destinations})
foreach(set DynamicFilterTargets DynamicFilterSimTargets)
  install(EXPORT ${set} NAMESPACE DynamicFilter:: DESTINATION ${DF_CMAKE_DIR} COMPONENT dev)
endforeach()

configure_package_config_file(cmake/DynamicFilterConfig.cmake.in ${PROJECT_BINARY_DIR}/DynamicFilterConfig.cmake
  INSTALL_DESTINATION ${DF_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/DynamicFilterConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/DynamicFilterConfig.cmake ${PROJECT_BINARY_DIR}/DynamicFilterConfigVersion.cmake
        DESTINATION ${DF_CMAKE_DIR} COMPONENT dev)

install(TARGETS dynamicfilter RUNTIME COMPONENT command)

# Where ROS 2 looks for what belongs to a package: `ros2 launch dynamicfilter live.launch.xml`.
if(DYNAMIC_FILTER_LIVE)
  set(ros2 ${CMAKE_INSTALL_DATADIR}/dynamicfilter)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packaging/ros2/bin)
  file(TOUCH ${PROJECT_BINARY_DIR}/packaging/ros2/dynamicfilter)
  file(CREATE_LINK ../../bin/dynamicfilter ${PROJECT_BINARY_DIR}/packaging/ros2/bin/dynamicfilter SYMBOLIC)
  install(FILES package.xml DESTINATION ${ros2} COMPONENT command)
  install(FILES packaging/ros2/live.launch.xml DESTINATION ${ros2}/launch COMPONENT command)
  install(FILES packaging/ros2/live.yaml DESTINATION ${ros2}/config COMPONENT command)
  install(DIRECTORY packaging/dynamicfilter_msgs DESTINATION ${ros2} COMPONENT command)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/ros2/dynamicfilter
          DESTINATION ${CMAKE_INSTALL_DATADIR}/ament_index/resource_index/packages COMPONENT command)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/ros2/bin/dynamicfilter DESTINATION lib/dynamicfilter COMPONENT command)
endif()

foreach(plugin mpi crs)
  if(TARGET dynamicfilter_${plugin})
    install(TARGETS dynamicfilter_${plugin} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/dynamicfilter COMPONENT ${plugin})
  endif()
endforeach()

# Where roslaunch looks for what belongs to a package of ROS.
if(TARGET dynamicfilter_ros1)
  set(ros ${CMAKE_INSTALL_DATADIR}/dynamicfilter_ros)
  configure_file(packaging/ros1/package.xml.in ${PROJECT_BINARY_DIR}/packaging/package.xml @ONLY)
  file(CREATE_LINK ../../bin/dynamicfilter_ros1 ${PROJECT_BINARY_DIR}/packaging/dynamicfilter_ros1 SYMBOLIC)
  install(TARGETS dynamicfilter_ros1 RUNTIME COMPONENT ros)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/package.xml ${PROJECT_BINARY_DIR}/packaging/dynamicfilter_ros1
          DESTINATION ${ros} COMPONENT ros)
  install(FILES packaging/ros1/dynamicfilter.launch DESTINATION ${ros}/launch COMPONENT ros)
endif()

set(DF_PYTHON_DIR lib/python3/dist-packages)  # the folder below /usr in which Debian's Python looks
if(DF_BUILD_PYTHON)
  install(TARGETS _dynamicfilter LIBRARY DESTINATION ${DF_PYTHON_DIR}/dynamicfilter COMPONENT python)
  install(FILES ${DF_PYTHON_SOURCES} DESTINATION ${DF_PYTHON_DIR}/dynamicfilter COMPONENT python)
  install(DIRECTORY ${DF_PYTHON_DIST_INFO} DESTINATION ${DF_PYTHON_DIR} COMPONENT python)
endif()

# Shared libraries are found relative to the program, so the installation can be moved.
if(BUILD_SHARED_LIBS)
  set_target_properties(${DF_LIBRARIES} PROPERTIES INSTALL_RPATH $ORIGIN)
  set_target_properties(dynamicfilter PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})
  if(TARGET dynamicfilter_ros1)
    set_target_properties(dynamicfilter_ros1 PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})
  endif()
  if(DF_BUILD_PYTHON)
    set_target_properties(_dynamicfilter PROPERTIES INSTALL_RPATH $ORIGIN/../../../../${CMAKE_INSTALL_LIBDIR})
  endif()
endif()
