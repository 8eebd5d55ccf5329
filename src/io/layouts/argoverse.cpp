// SPDX-License-Identifier: MIT
#include "dynamic_filter/error.hpp"
#include "io/folders.hpp"
#include "io/layouts/layouts.hpp"

namespace dynamic_filter::io {

void refuse_argoverse(const std::filesystem::path& data) {
    for (const auto& folder : {data / "sensors" / "lidar", data / "lidar", data}) {
        std::error_code ignored;
        if (list_files(folder, {".feather"}, ignored).empty()) continue;
        throw InputError(
            folder, "",
            "holds Apache Arrow's *.feather files, as logs of Argoverse 2 do, which are not read: "
            "with Python's pyarrow, write a .bin or .npy file for each sweep and a pose file from "
            "city_SE3_egovehicle.feather; docs/formats.md has the lines to type");
    }
}

}  // namespace dynamic_filter::io
