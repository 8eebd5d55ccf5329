# One place for flags. Values must not depend on the instruction set: no contraction, no reassociation.
add_library(dynamic_filter_flags INTERFACE)
target_compile_options(dynamic_filter_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Werror
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false positives on std::string in g++ 12 (PR 105651)
  -fno-semantic-interposition  # functions are inlined in position-independent code, too
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_definitions(dynamic_filter_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()
