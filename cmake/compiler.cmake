# All compiler flags. Results must not depend on the instruction set, so contraction and
# reassociation are off.
add_library(dynamic_filter_flags INTERFACE)
target_compile_options(dynamic_filter_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Werror
  # g++ 12 gives false warnings about std::string (PR 105651), which precompiled headers attribute
  # to this project.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
  -fno-semantic-interposition  # inlines functions in position-independent code, too
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_definitions(dynamic_filter_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# Headers that nearly every file includes are parsed only once.
set(DF_PRECOMPILED <Eigen/Geometry> <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional>
    <span> <string> <vector>)

# The sanitizers' builds compile several files as one (CMAKE_UNITY_BUILD), which takes a third of the time. Files whose
# internal names repeat those of others are compiled alone.
function(df_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

find_program(CCACHE ccache)
if(CCACHE)
  # The manual of ccache asks for this with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()
