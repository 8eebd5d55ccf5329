# Debian packages and a tarball that runs from wherever it is unpacked; script/package makes them.
# The libraries are static, so users need only their development package.
set(DF_DEBIAN ${PROJECT_SOURCE_DIR}/packaging/debian)
set(DF_GZIPPED ${PROJECT_BINARY_DIR}/packaging)
foreach(plain ${DF_DEBIAN}/changelog ${PROJECT_SOURCE_DIR}/packaging/dynamicfilter.1)
  cmake_path(GET plain FILENAME name)
  file(MAKE_DIRECTORY ${DF_GZIPPED})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${plain})
  execute_process(COMMAND gzip -9nc ${plain} OUTPUT_FILE ${DF_GZIPPED}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()
install(FILES ${DF_GZIPPED}/dynamicfilter.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES packaging/dynamicfilter.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME dynamicfilter COMPONENT command)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libdynamicfilter-dev COMPONENT dev)
set(components command dev)
set(packages dynamicfilter libdynamicfilter-dev)
foreach(component package IN ZIP_LISTS components packages)
  set(doc ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${DF_DEBIAN}/copyright DESTINATION ${doc} COMPONENT ${component})
  install(FILES ${DF_GZIPPED}/changelog.gz DESTINATION ${doc} RENAME changelog.Debian.gz COMPONENT ${component})
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
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME dynamicfilter)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "remove moving objects from LiDAR scans and maps
Labels every point of a recording as static, dynamic or unknown, from scans
and poses alone, and writes the map without what moves. Reads ROS bags, KITTI
and folders of clouds.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libdynamicfilter-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libeigen3-dev, libtbb-dev, libfmt-dev, libpng-dev, libsqlite3-dev, libzstd-dev, libbz2-dev, zlib1g-dev, liblz4-dev, pkg-config")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS libembree-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "remove moving objects from LiDAR scans, C++ libraries
Static libraries, headers and CMake files: the filter, its readers and
writers, scores, and a simulator (which needs libembree-dev).")
include(CPack)
