// SPDX-License-Identifier: MIT
// The page that npm built, as bytes of the command; nothing where it was not built.
#include "page/page.hpp"

#ifdef DYNAMIC_FILTER_VIEWER_PAGE
__asm__(
    ".pushsection .rodata\n"
    "viewer_page_begin: .incbin \"" DYNAMIC_FILTER_VIEWER_PAGE
    "\"\n"
    "viewer_page_end: .byte 0\n"
    ".globl viewer_page_begin, viewer_page_end\n"
    ".popsection\n");
extern "C" const char viewer_page_begin[], viewer_page_end[];
#endif

namespace dynamic_filter::app {

std::string_view viewer_page() {
#ifdef DYNAMIC_FILTER_VIEWER_PAGE
    return {viewer_page_begin, static_cast<std::size_t>(viewer_page_end - viewer_page_begin)};
#else
    return {};
#endif
}

}  // namespace dynamic_filter::app
