// SPDX-License-Identifier: MIT
#include "draw/png.hpp"

#include <png.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::io {

void write_png(const std::filesystem::path& path, const Image& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0,
                                  nullptr) == 0) {
        throw OutputError(path, std::string("cannot encode the picture: ") + header.message);
    }
    write_file(path, std::string_view(bytes).substr(0, size));
}

}  // namespace dynamic_filter::io
