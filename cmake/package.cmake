# Debian packages, and a tarball that runs from any folder; script/package builds them.
set(DF_DEBIAN ${PROJECT_SOURCE_DIR}/packaging/debian)
set(DF_PREPARED ${PROJECT_BINARY_DIR}/packaging)
foreach(plain ${DF_DEBIAN}/changelog ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter.1
        ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter-slurm.1 ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter_ros1.1
        ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
  cmake_path(GET plain FILENAME name)
  file(MAKE_DIRECTORY ${DF_PREPARED})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${plain})
  execute_process(COMMAND gzip -9nc ${plain} OUTPUT_FILE ${DF_PREPARED}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()
install(FILES ${DF_PREPARED}/dynamicfilter.1.gz ${DF_PREPARED}/dynamicfilter-slurm.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
if(TARGET dynamicfilter_ros1)
  install(FILES ${DF_PREPARED}/dynamicfilter_ros1.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ros)
endif()
install(PROGRAMS packaging/slurm/dynamicfilter-slurm DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(FILES packaging/make/dynamicfilter.mk DESTINATION ${CMAKE_INSTALL_DATADIR}/dynamicfilter COMPONENT command)
install(FILES packaging/dynamicfilter.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME dynamicfilter COMPONENT command)
configure_file(packaging/systemd/dynamicfilter-live@.service.in ${DF_PREPARED}/dynamicfilter-live@.service @ONLY)
install(FILES ${DF_PREPARED}/dynamicfilter-live@.service DESTINATION lib/systemd/system COMPONENT command)
install(FILES packaging/live.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/dynamicfilter/examples COMPONENT command)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libdynamicfilter-dev COMPONENT dev)
install(DIRECTORY examples/python/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-dynamicfilter/examples COMPONENT python)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/dynamicfilter COMPONENT command)

# The rest needs shared libraries: preset `package`.
if(NOT BUILD_SHARED_LIBS)
  return()
endif()
set(CPACK_COMPONENTS_ALL library dev command python)
set(DF_LIBRARY_PACKAGE libdynamicfilter${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(packages ${DF_LIBRARY_PACKAGE} libdynamicfilter-dev dynamicfilter python3-dynamicfilter)
set(sections libs libdevel science python)
if(TARGET dynamicfilter_ros1)
  list(APPEND CPACK_COMPONENTS_ALL ros)
  list(APPEND packages dynamicfilter-ros)
  list(APPEND sections science)
endif()
foreach(plugin mpi crs)
  if(TARGET dynamicfilter_${plugin})
    list(APPEND CPACK_COMPONENTS_ALL ${plugin})
    list(APPEND packages dynamicfilter-${plugin})
    list(APPEND sections science)
  endif()
endforeach()
foreach(component package section IN ZIP_LISTS CPACK_COMPONENTS_ALL packages sections)
  set(doc ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${DF_DEBIAN}/copyright DESTINATION ${doc} COMPONENT ${component})
  install(FILES ${DF_PREPARED}/changelog.gz DESTINATION ${doc} RENAME changelog.Debian.gz COMPONENT ${component})
  install(FILES ${DF_PREPARED}/CHANGELOG.md.gz DESTINATION ${doc} RENAME changelog.gz COMPONENT ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
endforeach()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_FILE_NAME dynamicfilter-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGE_CONTACT "The DynamicFilter authors <maintainers@dynamicfilter.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SOURCE dynamicfilter)
# dpkg-shlibdeps finds the dependencies on other packages. The own library is required in exactly
# the same version, because the command and the module use more of it than the public headers.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENT_DEV_DEPENDS library)
set(CPACK_COMPONENT_COMMAND_DEPENDS library)
set(CPACK_COMPONENT_PYTHON_DEPENDS library)
set(CPACK_COMPONENT_ROS_DEPENDS library)
# In exactly the same version, which the command checks.
set(CPACK_COMPONENT_MPI_DEPENDS command)
set(CPACK_COMPONENT_CRS_DEPENDS command)

foreach(library IN LISTS DF_LIBRARIES)
  get_target_property(soversion ${library} SOVERSION)
  string(APPEND shlibs "lib${library} ${soversion} ${DF_LIBRARY_PACKAGE} (>= ${PROJECT_VERSION})\n")
endforeach()
# CPack's own file would include the Python module, with a warning.
file(WRITE ${DF_PREPARED}/shlibs ${shlibs})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${DF_PREPARED}/shlibs ${DF_DEBIAN}/library/triggers)
install(FILES ${DF_DEBIAN}/library/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
        RENAME ${DF_LIBRARY_PACKAGE} COMPONENT library)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "remove moving objects from LiDAR scans, shared libraries
The filter, its readers and writers, scores, and a simulator, as the command
dynamicfilter and the Python module use them, and programs in C++ may.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS libeigen3-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "remove moving objects from LiDAR scans, C++ headers
Headers and CMake files of the filter, its readers and writers, scores, and a
simulator; with examples.")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "remove moving objects from LiDAR scans and maps
Labels every point of a recording as static, dynamic or unknown, from scans
and poses alone, and writes the map without what moves. Reads ROS bags, KITTI
and folders of clouds.")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "dynamicfilter-crs, dynamicfilter-mpi, parallel, slurm-client")
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_COMPONENT_MPI_DESCRIPTION "remove moving objects from LiDAR scans, on many machines by MPI
The plug-in for `dynamicfilter run --mpi`, by which the processes that mpirun
started share the tiles of a large run among them.")
set(CPACK_COMPONENT_CRS_DESCRIPTION "remove moving objects from LiDAR scans, coordinate systems of the earth
The plug-in for `dynamicfilter convert --crs`, which places clouds in a
projected coordinate system by PROJ and names it in LAS files.")
# roslaunch brings the master.
set(CPACK_DEBIAN_ROS_PACKAGE_RECOMMENDS python3-roslaunch)
set(CPACK_COMPONENT_ROS_DESCRIPTION "remove moving objects from LiDAR scans, node of ROS 1
Filters the scans of a running sensor: subscribes to its clouds and poses,
and publishes the clouds without what moves. With a launch file.")
# The module works with one minor version of Python only.
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3-numpy, \
python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${next_python})")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${DF_DEBIAN}/python/postinst ${DF_DEBIAN}/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "remove moving objects from LiDAR scans, Python module
The filter scan by scan with numpy's arrays, recordings and clouds as arrays,
and what the command does: run, evaluate, simulate.")
include(CPack)
