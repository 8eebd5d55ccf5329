// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "draw/png.hpp"

namespace dynamic_filter::app {

/// Pictures of one size, one after another, as an animated WebP that goes round for ever.
class Animation {
public:
    explicit Animation(int milliseconds_each);
    ~Animation();
    Animation(const Animation&) = delete;
    Animation& operator=(const Animation&) = delete;

    void add(const io::Image& picture);
    /// Writes the file, atomically; the last picture stays for two seconds. Throws OutputError.
    void write(const std::filesystem::path& file);

private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
    int step_, now_ = 0;  // [ms]
};

}  // namespace dynamic_filter::app
