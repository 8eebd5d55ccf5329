// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/clouds/field_types.hpp"
#include "formats/clouds/las_format.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kResolution = 0.001;  // [m] of coordinates
constexpr std::size_t header_bytes = 375, base_bytes = 30, returns_at = 14;
constexpr std::size_t intensity_at = 12, classification_at = 16;
constexpr std::size_t most_name = 32, most_u16 = 65535;
constexpr std::uint8_t unassigned = 1, temporal_exclusion = 22;  // classes of LAS 1.4

/// Fields for which point format 6 has a place.
struct Standard {
    const char* name;
    FieldType type;
    std::size_t at;
    unsigned first_bit, bits;
};
constexpr std::array standards = {Standard{"intensity", FieldType::u16, 12, 0, 16},
                                  Standard{"return_number", FieldType::u8, 14, 0, 4},
                                  Standard{"number_of_returns", FieldType::u8, 14, 4, 4},
                                  Standard{"classification", FieldType::u8, 16, 0, 8},
                                  Standard{"user_data", FieldType::u8, 17, 0, 8},
                                  Standard{"scan_angle", FieldType::f32, 18, 0, 16},
                                  Standard{"point_source_id", FieldType::u16, 20, 0, 16},
                                  Standard{"gps_time", FieldType::f64, 22, 0, 64}};

struct Placed {
    Field field;
    const Standard* standard = nullptr;  ///< null for Extra Bytes
    std::string name;                    ///< name in Extra Bytes
    std::size_t at = 0;                  ///< [bytes] offset in the record
};

struct Axis {
    std::vector<double> values;
    double least = 0.0, greatest = 0.0, offset = 0.0;
};

/// Consecutive little-endian numbers.
class LasBytes {
public:
    template <class T>
    LasBytes& put(T value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof value);
        store_at(bytes_.data() + at, value);
        return *this;
    }
    LasBytes& text(std::string_view text, std::size_t width) {
        for (std::size_t i = 0; i < width; ++i) put(i < text.size() ? text[i] : '\0');
        return *this;
    }
    LasBytes& append(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    LasBytes& zeros(std::size_t count) { return text("", count); }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

const Standard* standard_named(const std::string& name) {
    const auto* found = std::find_if(standards.begin(), standards.end(),
                                     [&](const Standard& s) { return s.name == name; });
    return found == standards.end() ? nullptr : found;
}

/// True if the standard field represents the values of the field exactly. The scan angle has
/// another unit in the file, so it is never exact.
bool holds(const Standard& standard, const Cloud& cloud, const Field& field) {
    if (standard.type != field.type || field.type == FieldType::f32) return false;
    if (standard.bits >= 8) return true;
    const std::vector<double> all = values(cloud, field);
    return std::all_of(all.begin(), all.end(),
                       [&](double v) { return v < std::exp2(standard.bits); });
}

std::vector<Placed> place(const Cloud& cloud) {
    std::vector<Placed> placed;
    std::size_t end = base_bytes;
    for (const Field& field : single_fields(cloud)) {
        if (field.name == "x" || field.name == "y" || field.name == "z") continue;
        const Standard* standard = standard_named(field.name);
        if (standard != nullptr && holds(*standard, cloud, field)) {
            placed.push_back({field, standard, "", standard->at});
            continue;
        }
        const std::string name = field.name + std::string(standard != nullptr ? las_exact : "");
        placed.push_back({field, nullptr, name, end});
        end += size_of(field.type);
    }
    return placed;
}

/// What other programs show as the intensity, for values that the standard field cannot hold; these
/// are in Extra Bytes.
struct ShownIntensity {
    std::vector<double> values;  ///< empty: the standard field holds them, or there are none
    double factor = 1.0;
    [[nodiscard]] std::uint16_t at(std::size_t i) const {
        const double scaled = std::round(factor * values[i]);
        return static_cast<std::uint16_t>(std::clamp(scaled, 0.0, static_cast<double>(most_u16)));
    }
    [[nodiscard]] std::string note() const {
        if (values.empty() || factor == 1.0) return "";
        return fmt::format("; the standard intensity is {:.6g} times the given one", factor);
    }
};

/// Fractions of one, and what exceeds 16 bits, are scaled to 16 bits; else values stay what they
/// are.
ShownIntensity shown_intensity(const Cloud& cloud, const std::vector<Placed>& placed) {
    const auto exact = std::find_if(placed.begin(), placed.end(), [](const Placed& p) {
        return p.standard == nullptr && p.field.name == "intensity";
    });
    if (exact == placed.end()) return {};
    ShownIntensity shown{values(cloud, exact->field)};
    double greatest = 0.0;
    bool has_fractions = false;
    for (double& value : shown.values) {
        if (!std::isfinite(value)) value = 0.0;
        greatest = std::max(greatest, value);
        has_fractions |= value != std::floor(value);
    }
    if (greatest <= 1.0 && has_fractions) shown.factor = static_cast<double>(most_u16);
    if (greatest > static_cast<double>(most_u16)) {
        shown.factor = static_cast<double>(most_u16) / greatest;
    }
    return shown;
}

/// The classes of the points that moved and of the others; empty if the cloud does not tell, or has
/// classes of its own.
std::vector<std::uint8_t> classes_of(const Cloud& cloud) {
    const Field* const dynamic = cloud.find("dynamic");
    if (dynamic == nullptr || cloud.find("classification") != nullptr) return {};
    std::vector<std::uint8_t> classes;
    for (const double moved : values(cloud, *dynamic)) {
        classes.push_back(moved != 0.0 ? temporal_exclusion : unassigned);
    }
    return classes;
}

std::size_t record_bytes_of(const std::vector<Placed>& placed) {
    std::size_t bytes = base_bytes;
    for (const Placed& p : placed) bytes += p.standard == nullptr ? size_of(p.field.type) : 0;
    return bytes;
}

std::vector<std::byte> extra_record(const std::vector<Placed>& placed,
                                    const std::filesystem::path& path) {
    LasBytes record;
    for (const Placed& p : placed) {
        if (p.standard != nullptr) continue;
        if (p.name.size() > most_name) {
            throw OutputError(path, "the name of field '" + p.field.name +
                                        "' is longer than the 32 characters that LAS holds");
        }
        const auto* code = std::find(las_extra_types.begin(), las_extra_types.end(), p.field.type);
        record.zeros(2).put(static_cast<std::uint8_t>(code - las_extra_types.begin() + 1));
        record.zeros(1).text(p.name, most_name).zeros(las_extra_bytes - 4 - most_name);
    }
    if (record.bytes().size() > most_u16 || record_bytes_of(placed) > most_u16) {
        throw OutputError(path, fmt::format("{} fields are more than LAS holds", placed.size()));
    }
    return record.bytes();
}

Axis axis_of(const Cloud& cloud, const char* name, const std::filesystem::path& path) {
    const Field* field = cloud.find(name);
    if (field == nullptr) throw OutputError(path, fmt::format("the cloud has no field '{}'", name));
    return {values(cloud, *field)};
}

/// Indices of the points with three finite coordinates.
std::vector<std::size_t> finite_points(const std::array<Axis, 3>& axes) {
    std::vector<std::size_t> finite;
    for (std::size_t i = 0; i < axes[0].values.size(); ++i) {
        const bool good = std::all_of(axes.begin(), axes.end(), [&](const Axis& axis) {
            return std::isfinite(axis.values[i]);
        });
        if (good) finite.push_back(i);
    }
    return finite;
}

std::int32_t steps(const Axis& axis, double value) {
    return static_cast<std::int32_t>(std::llround((value - axis.offset) / kResolution));
}

/// Chooses the offset of an axis in the middle of the data, in whole metres, so that 32 bits reach
/// to both sides. The bounds are computed from the coordinates as written, because readers check
/// whether points lie outside.
void span_axis(Axis& axis, char name, const std::vector<std::size_t>& points,
               const std::filesystem::path& path) {
    if (points.empty()) return;
    axis.least = axis.greatest = axis.values[points[0]];
    for (const std::size_t i : points) {
        axis.least = std::min(axis.least, axis.values[i]);
        axis.greatest = std::max(axis.greatest, axis.values[i]);
    }
    axis.offset = std::round(axis.least / 2 + axis.greatest / 2);
    if (!(axis.greatest - axis.offset <
          kResolution * std::numeric_limits<std::int32_t>::max() - 1)) {
        throw OutputError(
            path, fmt::format("the cloud goes from {0} = {1:.6g} to {2:.6g} m, wider than the "
                              "4,000 km that LAS holds at its scale of 1 mm; are these "
                              "coordinates right? .pcd, .ply and .npy hold any",
                              name, axis.least, axis.greatest));
    }
    for (double* bound : {&axis.least, &axis.greatest}) {
        *bound = steps(axis, *bound) * kResolution + axis.offset;
    }
}

/// Writes the bits of a standard field beside those of another field in the same byte.
void put_standard(std::byte* record, const Standard& standard, const std::byte* value) {
    if (standard.bits >= 8) {
        std::memcpy(record + standard.at, value, size_of(standard.type));
        return;
    }
    record[standard.at] |= *value << standard.first_bit;
}

/// Sets "one return of one" where the cloud does not contain these fields.
void complete_returns(std::byte* record) {
    const auto returns = std::to_integer<unsigned>(record[returns_at]);
    const unsigned number = std::max(returns & 15U, 1U);
    const unsigned count = std::max(returns >> 4U, number);
    record[returns_at] = static_cast<std::byte>(count << 4U | number);
}

std::vector<std::byte> records_of(const Cloud& cloud, const std::vector<Placed>& placed,
                                  const std::array<Axis, 3>& axes,
                                  const std::vector<std::size_t>& points,
                                  const ShownIntensity& intensity) {
    const std::vector<std::uint8_t> classes = classes_of(cloud);
    const std::size_t stride = record_bytes_of(placed);
    std::vector<std::byte> records(points.size() * stride);
    for (std::size_t n = 0; n < points.size(); ++n) {
        std::byte* record = records.data() + n * stride;
        const std::byte* from = cloud.data.data() + points[n] * cloud.point_bytes;
        for (std::size_t a = 0; a < 3; ++a)
            store_at(record + 4 * a, steps(axes[a], axes[a].values[points[n]]));
        for (const Placed& p : placed) {
            if (p.standard != nullptr) {
                put_standard(record, *p.standard, from + p.field.offset);
            } else {
                std::memcpy(record + p.at, from + p.field.offset, size_of(p.field.type));
            }
        }
        if (!intensity.values.empty()) store_at(record + intensity_at, intensity.at(points[n]));
        if (!classes.empty()) store_at(record + classification_at, classes[points[n]]);
        complete_returns(record);
    }
    return records;
}

std::array<std::uint64_t, 15> count_returns(const std::vector<std::byte>& records,
                                            std::size_t stride) {
    std::array<std::uint64_t, 15> counts{};
    for (std::size_t at = returns_at; at < records.size(); at += stride) {
        ++counts[(std::to_integer<std::size_t>(records[at]) & 15U) - 1];
    }
    return counts;
}

/// Records between header and points.
class VariableRecords {
public:
    void add(std::string_view user, std::uint16_t id, std::string_view what,
             std::span<const std::byte> record) {
        bytes_.zeros(2).text(user, 16).put(id);
        bytes_.put(static_cast<std::uint16_t>(record.size())).text(what, 32).append(record);
        ++count_;
    }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_.bytes(); }
    [[nodiscard]] std::uint32_t count() const { return count_; }

private:
    LasBytes bytes_;
    std::uint32_t count_ = 0;
};

VariableRecords variable_records(const Cloud& cloud, const std::vector<Placed>& placed,
                                 const std::filesystem::path& path) {
    VariableRecords records;
    if (!cloud.crs.empty() && !cloud.crs.starts_with(las_epsg)) {
        const auto wkt = std::as_bytes(std::span(cloud.crs.c_str(), cloud.crs.size() + 1));
        if (wkt.size() > most_u16) {
            throw OutputError(path,
                              "the coordinate system takes more than the 65,535 bytes of LAS");
        }
        records.add(las_projection, las_wkt_id, "OGC WKT", wkt);
    }
    const std::vector<std::byte> extra = extra_record(placed, path);
    if (!extra.empty()) records.add(las_spec, las_extra_id, "Extra Bytes", extra);
    return records;
}

struct Sizes {
    std::size_t variable = 0, stride = 0;  ///< [bytes]
    std::uint32_t variable_records = 0;
    std::uint64_t points = 0;
};

LasBytes header_of(const Sizes& sizes, const Cloud& cloud, const std::array<Axis, 3>& axes,
                   const std::array<std::uint64_t, 15>& returns) {
    // Point formats from 6 on require the bit of a coordinate system in WKT, also where there is
    // none; PDAL refuses files without it.
    const auto encoding = static_cast<std::uint16_t>(
        las_wkt_bit | (cloud.gps_time_is_adjusted ? las_adjusted_time_bit : 0));
    LasBytes header;
    header.text("LASF", 4).put(std::uint16_t{0}).put(encoding).zeros(16);
    header.put(std::uint8_t{1}).put(std::uint8_t{4}).text("", 32).text("DynamicFilter", 32);
    header.zeros(4).put(static_cast<std::uint16_t>(header_bytes));
    header.put(static_cast<std::uint32_t>(header_bytes + sizes.variable));
    header.put(sizes.variable_records);
    header.put(std::uint8_t{6}).put(static_cast<std::uint16_t>(sizes.stride)).zeros(24);
    for (std::size_t a = 0; a < 3; ++a) header.put(kResolution);
    for (const Axis& axis : axes) header.put(axis.offset);
    for (const Axis& axis : axes) header.put(axis.greatest).put(axis.least);
    header.zeros(20).put(sizes.points);
    for (const std::uint64_t count : returns) header.put(count);
    return header;
}

}  // namespace

Written write_las(const std::filesystem::path& path, const Cloud& cloud) {
    std::array<Axis, 3> axes = {axis_of(cloud, "x", path), axis_of(cloud, "y", path),
                                axis_of(cloud, "z", path)};
    const std::vector<std::size_t> points = finite_points(axes);
    for (std::size_t a = 0; a < 3; ++a) span_axis(axes[a], "xyz"[a], points, path);
    const std::vector<Placed> placed = place(cloud);
    const VariableRecords variable = variable_records(cloud, placed, path);
    const ShownIntensity intensity = shown_intensity(cloud, placed);
    const std::vector<std::byte> records = records_of(cloud, placed, axes, points, intensity);
    const Sizes sizes{variable.bytes().size(), record_bytes_of(placed), variable.count(),
                      points.size()};
    const LasBytes header = header_of(sizes, cloud, axes, count_returns(records, sizes.stride));
    AtomicFile file(path);
    file.write(header.bytes());
    file.write(variable.bytes());
    file.write(records);
    file.commit();
    const std::size_t lost = cloud.size() - points.size();
    std::string rounded = "coordinates are rounded to 1 mm" + intensity.note();
    if (cloud.crs.starts_with(las_epsg)) {
        rounded += fmt::format(
            "; the coordinate system {} is left out, because it is given by GeoTIFF keys, and LAS "
            "1.4 wants WKT (`dynamicfilter convert --crs {}` writes that)",
            cloud.crs, cloud.crs);
    }
    if (lost == 0) return {points.size(), rounded};
    return {points.size(),
            rounded + fmt::format("; {} points that are not finite are left out", lost)};
}

}  // namespace dynamic_filter::io
