# What users get: the command (component `command`); the libraries, their headers and DynamicFilterConfig.cmake (`dev`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(DF_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/DynamicFilter)

# The core's headers that users include, and what these include; the others are its own.
set(DF_CORE_HEADERS
  config.hpp dynamic_filter.hpp error.hpp parallel.hpp stage_times.hpp types.hpp
  back_end/evidence.hpp back_end/sight.hpp geometry/range_image.hpp
  pipeline/dynamic_filter.hpp pipeline/online_filter.hpp)
foreach(header ${DF_CORE_HEADERS})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES include/dynamic_filter/${header} COMPONENT dev
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dynamic_filter/${folder})
endforeach()
install(DIRECTORY include/dynamic_filter/io include/dynamic_filter/eval include/dynamic_filter/sim COMPONENT dev
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dynamic_filter)

# The simulator is apart because only it needs Embree.
foreach(part io eval sim)
  set_target_properties(dynamic_filter_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()
install(TARGETS dynamic_filter dynamic_filter_io dynamic_filter_eval EXPORT DynamicFilterTargets
        ARCHIVE COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS dynamic_filter_sim EXPORT DynamicFilterSimTargets ARCHIVE COMPONENT dev)
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
