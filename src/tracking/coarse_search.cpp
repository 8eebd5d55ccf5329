// SPDX-License-Identifier: MIT
#include "tracking/coarse_search.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/voxel.hpp"

namespace dynamic_filter {
namespace {

constexpr float kCell = 0.5F;             // [m] cell size of the raster
constexpr int kHalf = 120;                // cells from the center of the raster to its border
constexpr float kTall = 0.5F;             // [m] height of a column that counts as upright
constexpr double kTurnStep = 0.0175;      // [rad] one degree
constexpr std::size_t kMostPoints = 500;  // of the scan
constexpr std::size_t kFewestPoints = 30;

using Flat = std::vector<Eigen::Vector2f>;

/// One place, seen from above, for each column of points that is tall enough.
Flat upright_columns(const Points& points) {
    struct Column {
        float low, high;
        Eigen::Vector2f sum = Eigen::Vector2f::Zero();
        float count = 0.0F;
    };
    tsl::robin_map<VoxelKey, std::size_t, VoxelHash> numbers;
    // In the order of the points, so that results do not depend on the hash.
    std::vector<Column> columns;
    for (const Point& p : points) {
        const auto cell = cell_of({p.x(), p.y(), 0.0F}, 1.0F / kCell);
        if (!cell) continue;
        const auto [it, fresh] = numbers.try_emplace(pack(*cell), columns.size());
        if (fresh) columns.push_back({p.z(), p.z()});
        Column& c = columns[it->second];
        c.low = std::min(c.low, p.z());
        c.high = std::max(c.high, p.z());
        c.sum += p.head<2>();
        c.count += 1.0F;
    }
    Flat upright;
    for (const Column& c : columns) {
        if (c.high - c.low > kTall) upright.emplace_back(c.sum / c.count);
    }
    return upright;
}

/// Raster of upright structures: 2 in a cell with a structure, 1 in the cells beside it.
class UprightRaster {
public:
    explicit UprightRaster(const Flat& places) {
        for (const auto& p : places) {
            const auto [x, y] = cell(p);
            if (!inside(x, y, 1)) continue;
            for (int dx = -1; dx <= 1; ++dx) {
                for (int dy = -1; dy <= 1; ++dy) {
                    auto& value = values_[index(x + dx, y + dy)];
                    value = std::max<std::uint8_t>(value, dx == 0 && dy == 0 ? 2 : 1);
                }
            }
        }
    }
    [[nodiscard]] int at(int x, int y) const { return inside(x, y, 0) ? values_[index(x, y)] : 0; }
    static std::pair<int, int> cell(const Eigen::Vector2f& p) {
        return {static_cast<int>(std::floor(p.x() / kCell)),
                static_cast<int>(std::floor(p.y() / kCell))};
    }

private:
    static bool inside(int x, int y, int margin) {
        return std::abs(x) < kHalf - margin && std::abs(y) < kHalf - margin;
    }
    static std::size_t index(int x, int y) {
        return static_cast<std::size_t>((x + kHalf) * 2 * kHalf + y + kHalf);
    }
    std::vector<std::uint8_t> values_ = std::vector<std::uint8_t>(std::size_t{4} * kHalf * kHalf);
};

struct Candidate {
    int score = 0, x = 0, y = 0, turn = 0;
};

std::vector<Candidate> correlate(const UprightRaster& raster, const Flat& scan, int cells,
                                 int turns) {
    std::vector<Candidate> found;
    std::vector<std::pair<int, int>> turned(scan.size());
    for (int turn = -turns; turn <= turns; ++turn) {
        const Eigen::Rotation2Df rotation(static_cast<float>(turn * kTurnStep));
        std::transform(scan.begin(), scan.end(), turned.begin(),
                       [&](const Eigen::Vector2f& p) { return UprightRaster::cell(rotation * p); });
        for (int x = -cells; x <= cells; ++x) {
            for (int y = -cells; y <= cells; ++y) {
                Candidate c{0, x, y, turn};
                for (const auto& [px, py] : turned) c.score += raster.at(px + x, py + y);
                found.push_back(c);
            }
        }
    }
    return found;
}

bool alike(const Candidate& a, const Candidate& b) {
    return std::abs(a.x - b.x) <= 2 && std::abs(a.y - b.y) <= 2 && std::abs(a.turn - b.turn) <= 3;
}

Pose displacement(const Candidate& c) {
    Pose pose = Pose::Identity();
    pose.linear() =
        Eigen::AngleAxisd(c.turn * kTurnStep, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Eigen::Vector3d(c.x, c.y, 0.0) * static_cast<double>(kCell);
    return pose;
}

}  // namespace

std::vector<Pose> search_displacements(const Points& map, const Points& scan,
                                       const SearchWindow& window, std::size_t count) {
    const Flat there = upright_columns(map);
    Flat here = upright_columns(scan);
    if (there.size() < kFewestPoints || here.size() < kFewestPoints) return {};
    if (here.size() > kMostPoints) {
        for (std::size_t i = 0; i < kMostPoints; ++i) here[i] = here[i * here.size() / kMostPoints];
        here.resize(kMostPoints);
    }
    const int cells = static_cast<int>(std::ceil(window.distance / static_cast<double>(kCell)));
    const int turns = static_cast<int>(std::ceil(window.turn / kTurnStep));
    std::vector<Candidate> found = correlate(UprightRaster(there), here, cells, turns);
    // Of equal candidates, the smallest motion is first.
    const auto least = [](const Candidate& c) {
        return std::tuple(-c.score, c.x * c.x + c.y * c.y + c.turn * c.turn, c.x, c.y, c.turn);
    };
    const std::size_t looked_at = std::min<std::size_t>(found.size(), 2000);
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(looked_at),
                      found.end(),
                      [&](const Candidate& a, const Candidate& b) { return least(a) < least(b); });
    std::vector<Candidate> best;
    for (std::size_t i = 0; i < looked_at && best.size() < count; ++i) {
        const auto same = [&](const Candidate& c) { return alike(c, found[i]); };
        if (std::none_of(best.begin(), best.end(), same)) best.push_back(found[i]);
    }
    std::vector<Pose> poses;
    for (const Candidate& c : best) poses.push_back(displacement(c));
    return poses;
}

}  // namespace dynamic_filter
