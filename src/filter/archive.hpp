// SPDX-License-Identifier: MIT
/// Values as bytes, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

/// Writes values one after the other, or reads them in the same order, so that one function of a
/// class does both. Single caller. Throws Error if the bytes that are read end early.
class Archive {
public:
    Archive() = default;  ///< writes
    explicit Archive(std::span<const std::byte> bytes) : from_(bytes), reads_(true) {}

    [[nodiscard]] bool reads() const { return reads_; }
    [[nodiscard]] bool is_at_end() const { return from_.empty(); }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(written_); }

    /// `T` must consist of its bytes, without pointers.
    template <class T>
    void value(T& value) {
        bytes_of(&value, 1, sizeof(T));
    }
    /// The number of values, then the values. Of each, the first `used` bytes: what follows is
    /// padding, or is not kept; it stays as it is in `T()`.
    template <class T>
    void values(std::vector<T>& values, std::size_t used = sizeof(T)) {
        std::uint64_t count = values.size();
        value(count);
        if (reads_) {
            if (count > from_.size() / used) refuse();
            values.assign(count, T());
        }
        bytes_of(values.data(), values.size(), used);
    }

private:
    [[noreturn]] static void refuse() {
        throw Error("these bytes are no evidence of a filter of this version");
    }
    /// The first bytes of all values, then the second ones: so they pack better.
    template <class T>
    void bytes_of(T* values, std::size_t count, std::size_t used) {
        auto* const bytes = reinterpret_cast<std::byte*>(values);
        if (!reads_) {
            written_.reserve(written_.size() + count * used);
            for (std::size_t at = 0; at < used; ++at) {
                for (std::size_t i = 0; i < count; ++i) {
                    written_.push_back(bytes[i * sizeof(T) + at]);
                }
            }
            return;
        }
        if (count * used > from_.size()) refuse();
        const std::byte* next = from_.data();
        for (std::size_t at = 0; at < used; ++at) {
            for (std::size_t i = 0; i < count; ++i) bytes[i * sizeof(T) + at] = *next++;
        }
        from_ = from_.subspan(count * used);
    }

    std::vector<std::byte> written_;
    std::span<const std::byte> from_;
    bool reads_ = false;
};

}  // namespace dynamic_filter
