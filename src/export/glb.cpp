// SPDX-License-Identifier: MIT
#include "export/glb.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/little_endian.hpp"
#include "draw/canvas.hpp"

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

constexpr int kBytes = 5121, kFloats = 5126, kVertices = 34962;  // constants of OpenGL

/// The parts of a file under way.
struct Glb {
    ordered_json json;
    std::string data;
};

/// Adds values as a buffer view with an accessor; returns the number of the accessor.
template <class T>
std::size_t add_accessor(Glb& glb, const std::vector<T>& values, const ordered_json& kind,
                         std::size_t count) {
    const std::size_t bytes = values.size() * sizeof(T), at = glb.data.size();
    glb.data.append(reinterpret_cast<const char*>(values.data()), bytes);
    glb.data.append((4 - bytes % 4) % 4, '\0');
    glb.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes}, {"target", kVertices}});
    ordered_json accessor = {{"bufferView", glb.json["bufferViews"].size() - 1}, {"count", count}};
    accessor.update(kind);
    glb.json["accessors"].push_back(accessor);
    return glb.json["accessors"].size() - 1;
}

std::size_t add_positions(Glb& glb, const TilePoints& points, const Eigen::Vector3d& origin) {
    std::vector<float> values;
    values.reserve(3 * points.size());
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3d& position : points.positions) {
        const Eigen::Vector3f at = (position - origin).cast<float>();
        box.extend(at);
        values.insert(values.end(), {at.x(), at.y(), at.z()});
    }
    const auto array = [](const Eigen::Vector3f& v) { return ordered_json{v.x(), v.y(), v.z()}; };
    return add_accessor(glb, values,
                        {{"componentType", kFloats},
                         {"type", "VEC3"},
                         {"min", array(box.min())},
                         {"max", array(box.max())}},
                        points.size());
}

/// Colours of glTF are linear, and those of a picture are not.
std::uint8_t linear(std::uint8_t value) {
    const double share = value / 255.0;
    const double light = share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    return static_cast<std::uint8_t>(std::lround(255.0 * light));
}

std::size_t add_colors(Glb& glb, const TilePoints& points, const HeightRange& heights) {
    std::vector<std::uint8_t> values;
    values.reserve(4 * points.size());
    for (const Eigen::Vector3d& position : points.positions) {
        const double share = (position.z() - heights.low) / (heights.high - heights.low);
        const io::Color color = height_color(static_cast<float>(std::clamp(share, 0.0, 1.0)));
        for (const std::uint8_t channel : color) values.push_back(linear(channel));
        values.push_back(255);
    }
    return add_accessor(glb, values,
                        {{"componentType", kBytes}, {"normalized", true}, {"type", "VEC4"}},
                        points.size());
}

std::string attribute_of_drives(std::size_t word) { return fmt::format("_SESSIONS_{}", word); }

ordered_json add_attributes(Glb& glb, const TilePoints& points, const Eigen::Vector3d& origin,
                            const HeightRange& heights) {
    ordered_json attributes;
    attributes["POSITION"] = add_positions(glb, points, origin);
    attributes["COLOR_0"] = add_colors(glb, points, heights);
    const ordered_json scalar = {{"componentType", kFloats}, {"type", "SCALAR"}};
    attributes["_PROBABILITY"] = add_accessor(glb, points.probability, scalar, points.size());
    // glTF has no 32-bit integers for points; floats are exact up to 16 million.
    const std::vector<float> scans(points.scans.begin(), points.scans.end());
    attributes["_SCANS"] = add_accessor(glb, scans, scalar, points.size());
    for (std::size_t word = 0; word < points.words; ++word) {
        std::vector<std::uint32_t> bits;
        for (std::size_t i = 0; i < points.size(); ++i)
            bits.push_back(points.drives[i * points.words + word]);
        attributes[attribute_of_drives(word)] =
            add_accessor(glb, bits, {{"componentType", kBytes}, {"type", "VEC4"}}, points.size());
    }
    return attributes;
}

/// What the attributes mean, for viewers that pick and style by them.
ordered_json metadata_of(std::size_t words) {
    ordered_json properties, places;
    const auto add = [&](const std::string& attribute, std::string name, ordered_json kind) {
        kind["required"] = true;
        properties[name] = kind;
        places[name] = {{"attribute", attribute}};
    };
    add("_PROBABILITY", "probability",
        {{"name", "Probability of being occupied"},
         {"type", "SCALAR"},
         {"componentType", "FLOAT32"}});
    add("_SCANS", "scans",
        {{"name", "Scans with a point in the voxel"},
         {"type", "SCALAR"},
         {"componentType", "FLOAT32"}});
    for (std::size_t word = 0; word < words; ++word) {
        add(attribute_of_drives(word), fmt::format("sessions_{}", word),
            {{"name", fmt::format("Drives {} to {} that saw the voxel, a bit each", 32 * word,
                                  32 * word + 31)},
             {"type", "VEC4"},
             {"componentType", "UINT8"}});
    }
    return {{"schema",
             {{"id", "dynamicfilter_map"}, {"classes", {{"voxel", {{"properties", properties}}}}}}},
            {"propertyAttributes",
             ordered_json::array({{{"class", "voxel"}, {"properties", places}}})}};
}

std::string file_of(const Glb& glb) {
    std::string json = glb.json.dump();
    json.append((4 - json.size() % 4) % 4, ' ');
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    const std::size_t total = kHeader + 2 * kChunkHeader + json.size() + glb.data.size();
    std::string bytes = "glTF";
    bytes.reserve(total);
    put(bytes, std::uint32_t{2});
    put(bytes, static_cast<std::uint32_t>(total));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<std::uint32_t>(glb.data.size()));
    bytes += std::string("BIN\0", 4) + glb.data;
    return bytes;
}

}  // namespace

std::string glb_of(const TilePoints& points, const Eigen::Vector3d& origin,
                   const HeightRange& heights) {
    constexpr int kPoints = 0;  // mode of the primitive
    Glb glb;
    glb.json["asset"] = {{"version", "2.0"},
                         {"generator", "DynamicFilter " DYNAMIC_FILTER_VERSION}};
    glb.json["extensionsUsed"] = {"KHR_materials_unlit", "EXT_structural_metadata"};
    glb.json["extensions"]["EXT_structural_metadata"] = metadata_of(points.words);
    glb.json["scene"] = 0;
    glb.json["scenes"] = ordered_json::array({{{"nodes", {0}}}});
    // From z up to y up, exactly, with the origin that floats could not hold.
    glb.json["nodes"] = ordered_json::array(
        {{{"mesh", 0},
          {"matrix",
           {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, origin.x(), origin.z(), -origin.y(), 1}}}});
    glb.json["materials"] = ordered_json::array(
        {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
          {"extensions", {{"KHR_materials_unlit", ordered_json::object()}}}}});
    const ordered_json attributes = add_attributes(glb, points, origin, heights);
    glb.json["meshes"] = ordered_json::array(
        {{{"primitives", ordered_json::array({{{"attributes", attributes},
                                               {"mode", kPoints},
                                               {"material", 0},
                                               {"extensions",
                                                {{"EXT_structural_metadata",
                                                  {{"propertyAttributes", {0}}}}}}}})}}});
    glb.json["buffers"] = ordered_json::array({{{"byteLength", glb.data.size()}}});
    return file_of(glb);
}

}  // namespace dynamic_filter::app
