// SPDX-License-Identifier: MIT
#include "formats/clouds/bin_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/input.hpp"
#include "base/numbers.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kFarthestReturn = 1000.0;  // [m] no sensor on a vehicle measures farther
constexpr double kSmallestNumber = 1e-6;    // [m] smaller numbers are bits of something else
constexpr std::size_t kFewestTold = 50;     // points with which a layout can be told
constexpr double kMuchSmoother = 0.5;       // another layout is this much smoother than KITTI's
constexpr double kLeastPlausible = 0.98;    // of the points of a plausible layout

/// Points of a sample: the values of point i begin at i * names.size().
std::vector<double> values_of(const BinSample& sample, const BinLayout& layout) {
    const std::size_t bytes = size_of(layout.type);
    const std::size_t count = sample.head.size() / layout.point_bytes() * layout.names.size();
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::byte* const from = sample.head.data() + i * bytes;
        if (layout.type == FieldType::f32) {
            float value = 0.0F;
            std::memcpy(&value, from, sizeof value);
            numbers[i] = static_cast<double>(value);
        } else {
            std::memcpy(&numbers[i], from, sizeof(double));
        }
    }
    return numbers;
}

/// How well a layout fits.
struct BinFit {
    std::size_t points = 0;  // that are measurements, of whatever size
    double plausible = 0.0;  // share of them within the range of sensors
    double finite = 0.0;     // share of them that may be coordinates in a world
    double roughness = 1.0;  // median of distances between neighbours, relative to their ranges
    std::vector<double>
        whole;  // for each value: share of points that have a small whole number there
    std::vector<double> size;            // for each value: median of its magnitude
    double range_of_second_half = 0.0;   // median, if it is a point
    std::optional<double> fourth, last;  // their values, if they are constant
};

bool is_within(const double* p, double limit) {
    const auto is_fine = [&](double v) {
        return v == 0.0 || (std::abs(v) >= kSmallestNumber && std::abs(v) <= limit);
    };
    return is_fine(p[0]) && is_fine(p[1]) && is_fine(p[2]);
}

double length(const double* p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

/// Median distance of points from those before them, relative to the sum of their ranges.
double roughness_of(const std::vector<const double*>& points) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double* const a = points[i - 1];
        const double* const b = points[i];
        const double step[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        steps.push_back(length(step) / (length(a) + length(b)));
    }
    return steps.empty() ? 1.0 : median(std::move(steps));
}

/// The value k of all points, if it is the same in all.
std::optional<double> constant_of(const std::vector<const double*>& points, std::size_t k) {
    const double first = points.front()[k];
    const bool is_constant =
        std::all_of(points.begin(), points.end(), [&](const double* p) { return p[k] == first; });
    return is_constant ? std::optional(first) : std::nullopt;
}

/// Of each value, what tells its meaning.
void describe_values(BinFit& fit, const std::vector<const double*>& points, std::size_t count) {
    constexpr double kMostRings = 255.0;
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<double> sizes;
        double whole = 0.0;
        for (const double* const p : points) {
            sizes.push_back(std::isfinite(p[k]) ? std::abs(p[k]) : 0.0);
            if (p[k] >= 0.0 && p[k] <= kMostRings && p[k] == std::floor(p[k])) whole += 1.0;
        }
        fit.whole.push_back(whole / static_cast<double>(points.size()));
        fit.size.push_back(median(std::move(sizes)));
    }
    if (count > 4) {
        fit.fourth = constant_of(points, 3);
        fit.last = constant_of(points, count - 1);
    }
    if (count % 2 != 0 || count < 6) return;
    std::vector<double> ranges;
    for (const double* const p : points) ranges.push_back(length(p + count / 2));
    fit.range_of_second_half = median(std::move(ranges));
}

BinFit fit_of(std::span<const BinSample> samples, const BinLayout& layout) {
    constexpr double kInWorld = 1e8;  // [m] also of maps in UTM
    BinFit fit;
    std::vector<std::vector<double>> numbers;
    std::vector<const double*> plausible;
    std::size_t finite = 0;
    for (const BinSample& sample : samples) numbers.push_back(values_of(sample, layout));
    for (const std::vector<double>& of_sample : numbers) {
        for (std::size_t i = 0; i < of_sample.size(); i += layout.names.size()) {
            const double* const p = of_sample.data() + i;
            const bool is_zero = p[0] == 0.0 && p[1] == 0.0 && p[2] == 0.0;
            // A beam without a return may be NaN; then all of it is.
            const bool is_nan = std::isnan(p[0]) && std::isnan(p[1]) && std::isnan(p[2]);
            if (is_zero || is_nan) continue;
            ++fit.points;
            if (is_within(p, kInWorld)) ++finite;
            if (is_within(p, kFarthestReturn)) plausible.push_back(p);
        }
    }
    if (fit.points == 0) return fit;
    fit.plausible = static_cast<double>(plausible.size()) / static_cast<double>(fit.points);
    fit.finite = static_cast<double>(finite) / static_cast<double>(fit.points);
    if (plausible.empty()) return fit;
    fit.roughness = roughness_of(plausible);
    describe_values(fit, plausible, layout.names.size());
    return fit;
}

/// True if the second half of a point is another one, as where every second point is far behind
/// that before it: its coordinates are no whole numbers, and no unit vector.
bool is_two_points(const BinFit& fit) {
    constexpr double kUnitVector = 1.5, kFew = 0.5;
    const std::size_t half = fit.size.size() / 2;
    if (fit.size.size() % 2 != 0 || half < 3) return false;
    if (half == 4 && fit.fourth && fit.fourth == fit.last) return true;  // as all intensities
    const bool are_fractions =
        std::all_of(fit.whole.begin() + static_cast<std::ptrdiff_t>(half),
                    fit.whole.begin() + static_cast<std::ptrdiff_t>(half) + 3,
                    [&](double share) { return share < kFew; });
    return are_fractions && fit.range_of_second_half > kUnitVector;
}

/// True for points as PCL has them in memory: x y z 1, intensity and zeros.
bool is_of_pcl(const BinFit& fit) {
    return fit.size.size() == 8 && fit.fourth == 1.0 && fit.last == 0.0 && fit.size[5] == 0.0 &&
           fit.size[6] == 0.0;
}

/// Of three files, one may be truncated.
bool divides_most(std::span<const BinSample> samples, std::size_t bytes) {
    const auto whole = std::count_if(samples.begin(), samples.end(),
                                     [&](const BinSample& s) { return s.size % bytes == 0; });
    return 5 * whole >= 3 * static_cast<std::ptrdiff_t>(samples.size());
}

/// The layout with the names that its values tell.
BinLayout named(BinLayout layout, const BinFit& fit) {
    constexpr double kNearlyAll = 0.999;
    std::size_t next = 3;
    for (std::size_t k = 3; k < layout.names.size(); ++k) layout.names[k] = fmt::format("c{}", k);
    if (layout.names.size() == 8 && fit.fourth) next = 4;  // the fourth coordinate of PCL's points
    if (next < layout.names.size()) layout.names[next] = "intensity";
    const std::size_t ring = next + 1;
    const bool has_ring = ring < layout.names.size() && next == 3 &&
                          fit.whole[ring] >= kNearlyAll && fit.size[ring] > 0.0;
    if (has_ring) layout.names[ring] = "ring";
    return layout;
}

}  // namespace

std::string to_string(const BinLayout& layout) {
    return fmt::format("{} {}", layout.type == FieldType::f32 ? "float32" : "float64",
                       fmt::join(layout.names, " "));
}

const std::vector<BinLayout>& bin_layouts() {
    static const std::vector<BinLayout> layouts = [] {
        std::vector<BinLayout> all = {{FieldType::f32, {"x", "y", "z", "intensity"}}};
        const auto add = [&](FieldType type, std::size_t values) {
            BinLayout layout{type, {"x", "y", "z"}};
            for (std::size_t k = 3; k < values; ++k)
                layout.names.push_back(k == 3 ? "intensity" : fmt::format("c{}", k));
            all.push_back(std::move(layout));
        };
        for (const std::size_t values : {3U, 5U, 6U, 8U}) add(FieldType::f32, values);
        for (const std::size_t values : {4U, 3U, 5U, 6U}) add(FieldType::f64, values);
        return all;
    }();
    return layouts;
}

BinChoice choose_bin_layout(std::span<const BinSample> samples) {
    const BinLayout& own = bin_layouts().front();
    const BinFit of_own = fit_of(samples, own);
    // By its contents alone: a file whose size does not fit is truncated, and named when it is
    // read.
    const bool own_is_plausible = of_own.plausible >= kLeastPlausible;
    if (of_own.points < kFewestTold) return {own, false};
    BinChoice best{own, true};
    double least = own_is_plausible ? kMuchSmoother * of_own.roughness : kMuchSmoother;
    bool is_found = own_is_plausible;
    for (const BinLayout& layout : std::span(bin_layouts()).subspan(1)) {
        if (!divides_most(samples, layout.point_bytes())) continue;
        const BinFit fit = fit_of(samples, layout);
        // Of points without intensity, KITTI's layout makes as many without a return.
        const bool is_smooth = fit.roughness < least ||
                               (is_of_pcl(fit) && fit.roughness < of_own.roughness / kMuchSmoother);
        const bool fits = fit.points >= kFewestTold && fit.plausible >= kLeastPlausible &&
                          is_smooth && !is_two_points(fit);
        if (!fits) continue;
        least = fit.roughness;
        best.layout = named(layout, fit);
        is_found = true;
    }
    if (is_found || of_own.finite >= kMuchSmoother) return best;
    return {std::nullopt, true};
}

void refuse_bad_bin_size(const std::filesystem::path& file, std::size_t bytes,
                         const BinLayout& layout) {
    const std::size_t stride = layout.point_bytes();
    if (bytes != 0 && bytes % stride == 0) return;
    throw InputError(file, fmt::format("byte {}", bytes - bytes % stride),
                     bytes == 0
                         ? fmt::format("is empty; expected {} bytes a point", stride)
                         : fmt::format("its size of {} bytes is no multiple of {} ({}); it is "
                                       "truncated",
                                       bytes, stride, to_string(layout)));
}

Cloud read_bin(const std::filesystem::path& file, const BinLayout& layout) {
    Cloud cloud;
    for (const std::string& name : layout.names) add_field(cloud, name, layout.type);
    cloud.data = read_bytes(file);
    refuse_bad_bin_size(file, cloud.data.size(), layout);
    return cloud;
}

}  // namespace dynamic_filter::io
