// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "check/motion.hpp"
#include "commands/cleaning.hpp"
#include "commands/picture.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/frames.hpp"
#include "run/commands.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

int render(const RenderOptions& o) {
    const std::string extension = extension_of(o.output);
    if (extension == ".webp") {
        const Config config = load_config(o.config);
        io::Sequence sequence = open(o.data);
        ensure_poses(sequence, config, o.data.deskew, false);
        animate_cleaning(sequence, config, o);
    } else if (extension == ".png") {
        const fs::path& in = o.data.data;
        if (fs::is_directory(in) && !fs::exists(in / "static_map.pcd")) {
            throw InputError(in, "",
                             "holds no static_map.pcd; expected the output folder of a run, a "
                             "cloud, or, to animate a recording, -o NAME.webp");
        }
        io::write_png(o.output, picture_of(o));
    } else {
        throw ConfigError(o.output.string() +
                          ": is neither .png (a picture) nor .webp (a "
                          "recording being cleaned)");
    }
    fmt::print("written {}\n", o.output.string());
    return kDone;
}

}  // namespace dynamic_filter::app
