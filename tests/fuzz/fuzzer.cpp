// SPDX-License-Identifier: MIT
// DYNAMIC_FILTER_TARGET names the reader; see script/fuzz.
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto target = dynamic_filter::fuzz::targets().at(DYNAMIC_FILTER_TARGET);
    target({data, size});
    return 0;
}
