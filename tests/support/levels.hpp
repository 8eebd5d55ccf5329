// SPDX-License-Identifier: MIT
/// The instruction-set levels of a kernel that this machine can run. Those that it lacks are named
/// on the terminal: they are not tested.
#pragma once

#include <iostream>
#include <string>
#include <vector>

namespace dynamic_filter::test {

template <class Function>
struct Level {
    std::string name;
    Function* run;
    bool is_there;
};

template <class Function>
std::vector<Level<Function>> there(std::vector<Level<Function>> all) {
    for (const auto& level : all) {
        if (!level.is_there) {
            std::cerr << "SKIPPED: this machine has no " << level.name << ", so the kernel of that"
                      << " level is not tested\n";
        }
    }
    std::erase_if(all, [](const auto& level) { return !level.is_there; });
    return all;
}

}  // namespace dynamic_filter::test

#ifdef DYNAMIC_FILTER_X86_LEVELS
#define DYNAMIC_FILTER_LEVELS_OF(function)                                                \
    ::dynamic_filter::test::there(                                                        \
        std::vector<::dynamic_filter::test::Level<decltype(kernel::baseline::function)>>{ \
            {"baseline", kernel::baseline::function, true},                               \
            {"avx2", kernel::avx2::function, __builtin_cpu_supports("avx2") != 0},        \
            {"avx512f", kernel::avx512::function, __builtin_cpu_supports("avx512f") != 0}})
#else
#define DYNAMIC_FILTER_LEVELS_OF(function)                                                \
    ::dynamic_filter::test::there(                                                        \
        std::vector<::dynamic_filter::test::Level<decltype(kernel::baseline::function)>>{ \
            {"baseline", kernel::baseline::function, true}})
#endif
