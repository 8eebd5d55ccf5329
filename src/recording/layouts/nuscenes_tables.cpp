// SPDX-License-Identifier: MIT
#include "recording/layouts/nuscenes_tables.hpp"

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io::nuscenes {

using Json = nlohmann::json;

void each_entry(const std::filesystem::path& file, const std::function<void(const Json&)>& use) {
    try {
        for (const Json& entry : Json::parse(read_file(file))) use(entry);
    } catch (const Json::exception& error) {
        throw InputError(file, "", std::string("is no table of nuScenes: ") + error.what());
    }
}

std::string text_of(const Json& entry, const char* key) { return entry.at(key).get<std::string>(); }

Pose pose_of(const Json& entry, const std::filesystem::path& file) {
    const Lines where("", file);
    const Json& t = entry.at("translation");
    const Json& q = entry.at("rotation");
    const auto number = [](const Json& list, std::size_t i) { return list.at(i).get<double>(); };
    return pose_from_quaternion(
        {number(t, 0), number(t, 1), number(t, 2)},
        Eigen::Quaterniond(number(q, 0), number(q, 1), number(q, 2), number(q, 3)), "wxyz", where);
}

}  // namespace dynamic_filter::io::nuscenes
