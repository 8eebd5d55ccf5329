// SPDX-License-Identifier: MIT
#include "lzf.hpp"

#include <cstring>

namespace dynamic_filter::io {
namespace {

/// Reads codes and writes what they mean; every step checks both ends.
class Expander {
public:
    Expander(std::span<const std::byte> input, std::span<std::byte> output)
        : input_(input), output_(output) {}

    bool run() {
        while (in_ < input_.size()) {
            const std::size_t control = take();
            if (!(control < 32 ? literal(control + 1) : repeat(control))) return false;
        }
        return out_ == output_.size();
    }

private:
    std::size_t take() { return std::to_integer<std::size_t>(input_[in_++]); }

    bool literal(std::size_t length) {
        if (length > input_.size() - in_ || length > output_.size() - out_) return false;
        std::memcpy(output_.data() + out_, input_.data() + in_, length);
        in_ += length;
        out_ += length;
        return true;
    }

    bool repeat(std::size_t control) {
        std::size_t length = (control >> 5U) + 2;
        if (control >> 5U == 7) {  // a long one: the length goes on in the next byte
            if (in_ == input_.size()) return false;
            length += take();
        }
        if (in_ == input_.size()) return false;
        const std::size_t back = ((control & 31U) << 8U) + take() + 1;
        if (back > out_ || length > output_.size() - out_) return false;
        // Byte by byte: the repeat may overlap what it writes.
        for (; length > 0; --length, ++out_) output_[out_] = output_[out_ - back];
        return true;
    }

    std::span<const std::byte> input_;
    std::span<std::byte> output_;
    std::size_t in_ = 0, out_ = 0;
};

}  // namespace

std::optional<std::vector<std::byte>> lzf_expand(std::span<const std::byte> input,
                                                 std::size_t size) {
    if (size / lzf_most_expansion > input.size()) return std::nullopt;
    std::vector<std::byte> output(size);
    if (!Expander(input, output).run()) return std::nullopt;
    return output;
}

}  // namespace dynamic_filter::io
