// SPDX-License-Identifier: MIT
#include "fuzz/failing_new.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr long kAll = std::numeric_limits<long>::max();
std::atomic<long> granted{kAll};  // before the first that is refused; negative: so many came since
std::atomic<long> refused{0};

void* allocate(std::size_t size, std::size_t alignment) {
    const long left = granted.fetch_sub(1);
    if (left <= 0 && left > -refused) throw std::bad_alloc();
    // A whole multiple, as aligned_alloc asks, and not 0, which may give no address.
    const std::size_t whole = (size / alignment + 1) * alignment;
    if (void* memory = std::aligned_alloc(alignment, whole)) return memory;
    throw std::bad_alloc();
}

/// As algorithms ask that do with less memory as well.
void* allocate_or_null(std::size_t size) noexcept {
    try {
        return allocate(size, alignof(std::max_align_t));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate_or_null(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate_or_null(size);
}
void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace dynamic_filter::fuzz {

NoMemory::NoMemory(long k, long more) {
    refused = 1 + more;
    granted = k - 1;
}

NoMemory::~NoMemory() { granted = kAll; }

bool NoMemory::was_met() const { return granted < 0; }

}  // namespace dynamic_filter::fuzz
