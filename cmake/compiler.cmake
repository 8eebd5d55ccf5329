# One place for flags. Values must not depend on the instruction set: no contraction, no reassociation.
add_library(dynamic_filter_flags INTERFACE)
target_compile_options(dynamic_filter_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Werror
  # False positives on std::string in g++ 12 (PR 105651), which precompiling takes for ours.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
  -fno-semantic-interposition  # functions are inlined in position-independent code, too
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_definitions(dynamic_filter_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# What nearly every file includes is parsed once.
set(DF_PRECOMPILED <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional>
    <span> <string> <vector>)

find_program(CCACHE ccache)
if(CCACHE)
  # As its manual asks for with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()
