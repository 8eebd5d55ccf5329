// SPDX-License-Identifier: MIT
#include "live/largest_allocation.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

namespace {
thread_local std::size_t largest = 0;
}

void* operator new(std::size_t size) {
    largest = std::max(largest, size);
    void* const memory = std::malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace dynamic_filter::live {

std::size_t pop_largest_allocation() { return std::exchange(largest, 0); }

}  // namespace dynamic_filter::live
