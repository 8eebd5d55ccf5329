// SPDX-License-Identifier: MIT
#include "draw/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::io {
namespace png_test {

TEST(Png, ReadsBackEqual) {
    const test::TemporaryFolder folder;
    Image image{7, 5, {}};
    for (int i = 0; i < 35; ++i) {
        image.pixels.push_back(
            {static_cast<std::uint8_t>(7 * i), static_cast<std::uint8_t>(i), 200});
    }
    write_png(folder / "a.png", image);

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&header, (folder / "a.png").c_str()), 0);
    ASSERT_EQ(header.width, 7U);
    ASSERT_EQ(header.height, 5U);
    header.format = PNG_FORMAT_RGB;
    std::vector<Color> pixels(35);
    ASSERT_NE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(pixels, image.pixels);
}

TEST(Png, AFolderThatIsNotThereIsAnError) {
    EXPECT_THROW(write_png("/nowhere/a.png", {1, 1, {{0, 0, 0}}}), OutputError);
}

}  // namespace png_test
}  // namespace dynamic_filter::io
