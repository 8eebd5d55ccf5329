// SPDX-License-Identifier: MIT
#include "recording/mesh_mask.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "base/input.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kHeader = 80, kTriangle = 50;  // [bytes] of a binary file

bool is_usable(const Triangle& t) {
    return t[0].allFinite() && t[1].allFinite() && t[2].allFinite();
}

std::vector<Triangle> read_binary(std::span<const std::byte> bytes) {
    ByteReader reader(bytes, kHeader);
    std::vector<Triangle> triangles(reader.number<std::uint32_t>());
    for (Triangle& triangle : triangles) {
        reader.read(3 * sizeof(float));  // normal
        for (Point& corner : triangle) {
            for (float& value : corner) value = reader.number<float>();
        }
        reader.read(sizeof(std::uint16_t));
    }
    return triangles;
}

/// The lines "vertex x y z", three for each triangle.
std::vector<Triangle> read_text(const std::string& text, const std::filesystem::path& file) {
    Lines lines(text, file);
    std::vector<Point> corners;
    while (lines.next()) {
        const auto words = split_tokens(lines.line());
        if (words.empty() || words[0] != "vertex") continue;
        Point corner = Point::Constant(std::nanf(""));
        for (std::size_t k = 0; k < 3 && words.size() == 4; ++k) {
            corner[static_cast<Eigen::Index>(k)] =
                static_cast<float>(parse_real(words[k + 1]).value_or(std::nan("")));
        }
        if (!corner.allFinite()) lines.fail("expected \"vertex\" and three numbers");
        corners.push_back(corner);
    }
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
        triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return triangles;
}

/// Height [m] of a triangle above a place; empty if it is not above or below it.
std::optional<float> height_at(const Triangle& t, const Eigen::Vector2f& place) {
    const Eigen::Vector2f a = t[0].head<2>(), b = t[1].head<2>(), c = t[2].head<2>();
    const auto cross = [](const Eigen::Vector2f& u, const Eigen::Vector2f& v) {
        return u.x() * v.y() - u.y() * v.x();
    };
    const float area = cross(b - a, c - a);
    if (area == 0.0F) return std::nullopt;
    const float u = cross(b - place, c - place) / area, v = cross(c - place, a - place) / area;
    const float w = 1.0F - u - v;
    if (u < 0.0F || v < 0.0F || w < 0.0F) return std::nullopt;
    return u * t[0].z() + v * t[1].z() + w * t[2].z();
}

}  // namespace

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    std::vector<Triangle> triangles;
    const bool has_count = bytes.size() >= kHeader + sizeof(std::uint32_t);
    const std::size_t count =
        has_count ? little_endian<std::uint32_t>(bytes.data() + kHeader) : std::size_t{0};
    const bool is_binary =
        has_count && bytes.size() == kHeader + sizeof(std::uint32_t) + count * kTriangle;
    triangles = is_binary ? read_binary(bytes) : read_text(std::string(as_text(bytes)), file);
    std::erase_if(triangles, [](const Triangle& t) { return !is_usable(t); });
    if (triangles.empty()) {
        throw InputError(file, "", "has no triangles; expected STL, binary or text");
    }
    return triangles;
}

Boxes boxes_in(std::span<const Triangle> mesh) {
    constexpr float kCell = 0.1F, kMargin = 0.1F, kMost = 100.0F;  // [m]
    Eigen::AlignedBox3f around;
    for (const Triangle& t : mesh) {
        for (const Point& corner : t) around.extend(corner);
    }
    Boxes boxes;
    const Eigen::Array2i cells =
        (around.sizes().head<2>().cwiseMin(kMost) / kCell).array().ceil().cast<int>().max(1);
    for (int x = 0; x < cells.x(); ++x) {
        for (int y = 0; y < cells.y(); ++y) {
            const Eigen::Vector2f low =
                around.min().head<2>() +
                kCell * Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y));
            // Not exactly in the middle, where edges of meshes tend to lie.
            const Eigen::Vector2f place = low + kCell * Eigen::Vector2f(0.4937F, 0.5071F);
            std::vector<float> heights;
            for (const Triangle& t : mesh) {
                if (const auto height = height_at(t, place)) heights.push_back(*height);
            }
            if (heights.empty()) continue;
            std::sort(heights.begin(), heights.end());
            if (heights.size() % 2 != 0) heights = {heights.front(), heights.back()};
            for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
                const Point from(low.x(), low.y(), heights[k]);
                const Point to(low.x() + kCell, low.y() + kCell, heights[k + 1]);
                boxes.emplace_back(Point(from - Point::Constant(kMargin)),
                                   Point(to + Point::Constant(kMargin)));
            }
        }
    }
    return boxes;
}

}  // namespace dynamic_filter::io
