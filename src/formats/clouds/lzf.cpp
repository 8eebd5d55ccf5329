// SPDX-License-Identifier: MIT
#include "formats/clouds/lzf.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace dynamic_filter::io {
namespace {

/// Reads codes and writes the bytes that they stand for. Every step checks the ends of input and
/// output.
class Expander {
public:
    Expander(std::span<const std::byte> input, std::span<std::byte> output)
        : input_(input), output_(output) {}

    bool run() {
        while (in_ < input_.size()) {
            const std::size_t control = next_byte();
            if (!(control < 32 ? literal(control + 1) : repeat(control))) return false;
        }
        return out_ == output_.size();
    }

private:
    std::size_t next_byte() { return std::to_integer<std::size_t>(input_[in_++]); }

    bool literal(std::size_t length) {
        if (length > input_.size() - in_ || length > output_.size() - out_) return false;
        std::memcpy(output_.data() + out_, input_.data() + in_, length);
        in_ += length;
        out_ += length;
        return true;
    }

    bool repeat(std::size_t control) {
        std::size_t length = (control >> 5U) + 2;
        if (control >> 5U == 7) {  // the length continues in the next byte
            if (in_ == input_.size()) return false;
            length += next_byte();
        }
        if (in_ == input_.size()) return false;
        const std::size_t back = ((control & 31U) << 8U) + next_byte() + 1;
        if (back > out_ || length > output_.size() - out_) return false;
        // Copies byte by byte, because source and target may overlap.
        for (; length > 0; --length, ++out_) output_[out_] = output_[out_ - back];
        return true;
    }

    std::span<const std::byte> input_;
    std::span<std::byte> output_;
    std::size_t in_ = 0, out_ = 0;
};

/// Replaces bytes that repeat earlier ones within 8 KiB by references; a hash of the first three
/// bytes finds them.
class Packer {
public:
    explicit Packer(std::span<const std::byte> input) : input_(input), last_seen_(1U << hash_bits) {
        packed_.reserve(input.size() / 2);
    }

    std::vector<std::byte> run() {
        std::size_t at = 0;
        while (at + shortest <= input_.size()) {
            const std::size_t before = remember(at);
            const std::size_t length = before < at ? common(before, at) : 0;
            if (length < shortest) {
                ++at;
                continue;
            }
            literals(at);
            repeat(at - before - 1, length - 2);
            at += length;
            written_ = at;
        }
        literals(input_.size());
        return std::move(packed_);
    }

private:
    static constexpr std::size_t shortest = 3, longest = 264, farthest = 8192, most_literals = 32;
    static constexpr unsigned hash_bits = 14;

    /// An earlier position within reach of the same three bytes; `at` if there is none.
    std::size_t remember(std::size_t at) {
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, input_.data() + at, shortest);
        std::uint32_t& seen = last_seen_[bytes * 2654435761U >> (32 - hash_bits)];
        const std::size_t before = seen == 0 ? at : seen - 1;
        seen = static_cast<std::uint32_t>(at + 1);
        return at - before <= farthest ? before : at;
    }

    [[nodiscard]] std::size_t common(std::size_t before, std::size_t at) const {
        const std::size_t most = std::min(longest, input_.size() - at);
        std::size_t length = 0;
        while (length < most && input_[before + length] == input_[at + length]) ++length;
        return length;
    }

    void literals(std::size_t end) {
        while (written_ < end) {
            const std::size_t length = std::min(most_literals, end - written_);
            put(length - 1);
            const auto run = input_.subspan(written_, length);
            packed_.insert(packed_.end(), run.begin(), run.end());
            written_ += length;
        }
    }

    void repeat(std::size_t back, std::size_t length) {
        put(std::min<std::size_t>(length, 7) << 5U | back >> 8U);
        if (length >= 7) put(length - 7);
        put(back & 0xFFU);
    }

    void put(std::size_t byte) { packed_.push_back(static_cast<std::byte>(byte)); }

    std::span<const std::byte> input_;
    std::vector<std::uint32_t> last_seen_;  // 1 + position; 0: not seen
    std::vector<std::byte> packed_;
    std::size_t written_ = 0;  // number of input bytes that are in packed_
};

}  // namespace

std::optional<std::vector<std::byte>> lzf_expand(std::span<const std::byte> input,
                                                 std::size_t size) {
    if (size / lzf_most_expansion > input.size()) return std::nullopt;
    std::vector<std::byte> output(size);
    if (!Expander(input, output).run()) return std::nullopt;
    return output;
}

std::vector<std::byte> lzf_pack(std::span<const std::byte> input) { return Packer(input).run(); }

}  // namespace dynamic_filter::io
