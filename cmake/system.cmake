# Refuses systems on which results would be wrong, instead of failing in the middle of the build.
if(NOT CMAKE_SIZEOF_VOID_P EQUAL 8)
  math(EXPR bits "8 * ${CMAKE_SIZEOF_VOID_P}")
  message(FATAL_ERROR "DynamicFilter needs a 64-bit system, because maps of voxels outgrow 4 GB; this compiler builds for ${bits} bits")
endif()
if(NOT CMAKE_CXX_BYTE_ORDER STREQUAL LITTLE_ENDIAN)
  message(FATAL_ERROR "DynamicFilter needs a little-endian system, because it reads and writes the files of LiDARs as they lie in memory; this compiler builds for ${CMAKE_CXX_BYTE_ORDER}")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12
   OR CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  message(FATAL_ERROR "DynamicFilter needs g++ 12 or clang++ 14, for C++20; ${CMAKE_CXX_COMPILER} is ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}; choose another one with -DCMAKE_CXX_COMPILER=")
endif()
