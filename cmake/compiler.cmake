# All compiler flags. Results must not depend on the instruction set, so contraction and
# reassociation are off.
add_library(dynamic_filter_flags INTERFACE)
target_compile_options(dynamic_filter_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${DYNAMIC_FILTER_WERROR}>:-Werror>
  "$<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>"  # which g++'s -Wconversion has not either
  # g++ 12 gives false warnings about std::string (PR 105651), which precompiled headers attribute
  # to this project; and notes on a change of C++'s calling conventions on ARM before g++ 10.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-psabi;-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
  -fno-semantic-interposition  # inlines functions in position-independent code, too
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_definitions(dynamic_filter_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# Several files are compiled as one, which takes half of the time.
if(NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
endif()
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)

# Headers that many files include are parsed once for all libraries of a kind. The kind `core` computes, and is optimised as far
# as can be. The kind `tools` talks, prints and writes JSON; a third of the time to compile it went into optimising it.
set(DF_PRECOMPILED <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional>
    <span> <string> <vector>)
set(DF_core_OPTIONS "")
set(DF_tools_OPTIONS $<$<CONFIG:Release>:-O1>)
function(df_precompiled kind)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(name dynamic_filter_precompiled_${kind})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE dynamic_filter_flags Eigen3::Eigen ${arg_LIBRARIES})
  target_compile_options(${name} PRIVATE ${DF_${kind}_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${DF_PRECOMPILED} ${arg_HEADERS})
endfunction()
function(df_kind target kind)
  target_precompile_headers(${target} REUSE_FROM dynamic_filter_precompiled_${kind})
  target_compile_options(${target} PRIVATE ${DF_${kind}_OPTIONS})
endfunction()

# The sources of a library are all that lie in its folders.
function(df_sources variable)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${ARGN})
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

find_program(CCACHE ccache)
if(CCACHE)
  # The manual of ccache asks for this with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()
find_program(MOLD mold)
if(MOLD AND NOT CMAKE_CROSSCOMPILING)
  add_link_options(-fuse-ld=mold)
endif()
