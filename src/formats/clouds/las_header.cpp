// SPDX-License-Identifier: MIT
#include "formats/clouds/las_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/byte_reader.hpp"
#include "formats/clouds/las_format.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::array<std::size_t, 11> format_bytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// Byte offsets in the fixed header.
enum At : std::size_t {
    encoding_at = 6,
    version_at = 24,
    header_size_at = 94,
    counts_at = 96,  // offset of the points, variable records, point format, old number of points
    scale_at = 131,
    wide_count_at = 247
};

LasField plain(std::string name, FieldType type, std::size_t at) {
    return {std::move(name), type, at, type};
}

LasField bits(std::string name, std::size_t at, std::uint8_t first, std::uint8_t count) {
    LasField field = plain(std::move(name), FieldType::u8, at);
    field.first_bit = first;
    field.bits = count;
    return field;
}

/// Fields of point formats 0 to 5. Flags and waveforms are not read.
void add_old_fields(std::vector<LasField>& fields, unsigned format) {
    fields.push_back(bits("return_number", 14, 0, 3));
    fields.push_back(bits("number_of_returns", 14, 3, 3));
    fields.push_back(bits("classification", 15, 0, 5));
    fields.push_back({"scan_angle", FieldType::i8, 16, FieldType::f32});
    fields.push_back(plain("user_data", FieldType::u8, 17));
    fields.push_back(plain("point_source_id", FieldType::u16, 18));
    if (format != 0 && format != 2) fields.push_back(plain("gps_time", FieldType::f64, 20));
}

/// Fields of point formats 6 to 10.
void add_new_fields(std::vector<LasField>& fields) {
    constexpr double degrees_per_step = 0.006;
    fields.push_back(bits("return_number", 14, 0, 4));
    fields.push_back(bits("number_of_returns", 14, 4, 4));
    fields.push_back(plain("classification", FieldType::u8, 16));
    fields.push_back(plain("user_data", FieldType::u8, 17));
    fields.push_back({"scan_angle", FieldType::i16, 18, FieldType::f32, degrees_per_step});
    fields.push_back(plain("point_source_id", FieldType::u16, 20));
    fields.push_back(plain("gps_time", FieldType::f64, 22));
}

void add_colours(std::vector<LasField>& fields, unsigned format) {
    constexpr std::array<std::size_t, 11> colours_at = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
    std::size_t at = colours_at[format];
    if (at == 0) return;
    for (const char* name : {"red", "green", "blue"}) {
        fields.push_back(plain(name, FieldType::u16, at));
        at += 2;
    }
    if (format == 8 || format == 10) fields.push_back(plain("nir", FieldType::u16, at));
}

/// Names may contain blanks, which the headers of other formats cannot store; they are replaced.
std::string name_of(std::string_view raw) {
    std::string name(raw.substr(0, raw.find('\0')));
    for (char& c : name) {
        if (c <= ' ' || c > '~') c = '_';
    }
    return name;
}

class LasHeaderParser {
public:
    explicit LasHeaderParser(std::span<const std::byte> bytes) : bytes_(bytes) {}

    LasHeader parse() {
        if (ByteReader(bytes_).text(4) != "LASF") {
            throw Malformed("does not begin with 'LASF'; it is no LAS file");
        }
        read_layout();
        read_fields();
        read_variable_records();
        put_exact_in_place();
        return std::move(header_);
    }

private:
    void read_layout() {
        const auto encoding = ByteReader(bytes_, skip_to(encoding_at)).number<std::uint16_t>();
        header_.gps_time_is_adjusted = (encoding & las_adjusted_time_bit) != 0;
        ByteReader version(bytes_, skip_to(version_at));
        const unsigned major = version.number<std::uint8_t>();
        const unsigned minor = version.number<std::uint8_t>();
        if (major != 1 || minor > 4) {
            throw Malformed(fmt::format("is LAS {}.{}; 1.0 to 1.4 are read", major, minor));
        }
        header_size_ = ByteReader(bytes_, skip_to(header_size_at)).number<std::uint16_t>();
        ByteReader counts(bytes_, skip_to(counts_at));
        header_.begin = counts.number<std::uint32_t>();
        records_ = counts.number<std::uint32_t>();
        format_ = counts.number<std::uint8_t>();
        header_.record_bytes = counts.number<std::uint16_t>();
        header_.points = counts.number<std::uint32_t>();
        if (minor >= 4) {
            const auto wide = ByteReader(bytes_, skip_to(wide_count_at)).number<std::uint64_t>();
            if (wide != 0) header_.points = wide;  // some writers set only the old number of points
        }
        check_layout(minor >= 4 ? 375 : 227);
    }

    void check_layout(std::size_t least_header) const {
        if ((format_ & 0xC0U) != 0) {
            throw Malformed("compressed LAZ is not read; unpack it to LAS first, e.g. with laszip");
        }
        if (format_ >= format_bytes.size()) {
            throw Malformed(fmt::format("point format {} is unknown; 0 to 10 are read", format_));
        }
        if (header_.record_bytes < format_bytes[format_]) {
            throw Malformed(fmt::format("points of {} bytes; point format {} has at least {}",
                                        header_.record_bytes, format_, format_bytes[format_]));
        }
        if (header_size_ < least_header || header_.begin < header_size_ ||
            header_.begin > bytes_.size()) {
            throw Malformed(
                fmt::format("the points begin at byte {}, behind a header of {}, in a "
                            "file of {} bytes; it is truncated or damaged",
                            header_.begin, header_size_, bytes_.size()));
        }
    }

    void read_fields() {
        ByteReader numbers(bytes_, skip_to(scale_at));
        std::array<double, 6> v{};
        for (double& value : v) {
            value = numbers.number<double>();
            if (!std::isfinite(value)) throw Malformed("a scale or an offset is not finite");
        }
        if (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0) throw Malformed("a scale is 0");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            header_.fields.push_back({std::string(1, "xyz"[axis]), FieldType::i32, 4 * axis,
                                      FieldType::f64, v[axis], v[3 + axis]});
        }
        header_.fields.push_back(plain("intensity", FieldType::u16, 12));
        if (format_ < 6) {
            add_old_fields(header_.fields, format_);
        } else {
            add_new_fields(header_.fields);
        }
        add_colours(header_.fields, format_);
    }

    /// Reads the records between header and points. Each takes bytes, so a wrong number of records
    /// cannot cause an endless loop. Several descriptions of Extra Bytes follow each other.
    void read_variable_records() {
        std::size_t at = format_bytes[format_];
        ByteReader reader(bytes_.first(header_.begin), header_size_);
        for (std::uint32_t i = 0; i < records_; ++i) {
            reader.read(2);
            const std::string_view padded = reader.text(std::uint64_t{16});
            const std::string_view user = padded.substr(0, padded.find('\0'));
            const auto id = reader.number<std::uint16_t>();
            const auto length = reader.number<std::uint16_t>();
            reader.read(32);
            const auto record = reader.read(length);
            if (id == las_extra_id && user == las_spec) at = add_extra_fields(record, at);
            if (id == las_geo_keys_id && user == las_projection && header_.crs.empty()) {
                header_.crs = system_of_keys(ByteReader(record));
            }
            if (id == las_wkt_id && user == las_projection) {
                const std::string_view padded_wkt = ByteReader(record).text(record.size());
                const std::string_view wkt = padded_wkt.substr(0, padded_wkt.find('\0'));
                if (!wkt.empty()) header_.crs = wkt;
            }
        }
    }

    /// "EPSG:32633" if the GeoTIFF keys name a projected system by its code; else empty.
    static std::string system_of_keys(ByteReader keys) {
        constexpr std::size_t entry_bytes = 8;
        constexpr std::uint16_t user_defined = 32767;
        if (keys.left() < entry_bytes) return "";
        keys.read(entry_bytes);  // versions, number of keys
        while (keys.left() >= entry_bytes) {
            const auto key = keys.number<std::uint16_t>(), place = keys.number<std::uint16_t>();
            keys.read(sizeof(std::uint16_t));  // number of values
            const auto value = keys.number<std::uint16_t>();
            const bool is_here = key == las_projected_system_key && place == 0;
            if (is_here && value != 0 && value != user_defined) {
                return fmt::format("{}{}", las_epsg, value);
            }
        }
        return "";
    }

    /// Adds the fields that begin `at` this byte of a point; returns where they end. Those beyond
    /// the record of a point are described, but not there.
    std::size_t add_extra_fields(std::span<const std::byte> record, std::size_t at) {
        for (ByteReader entries(record); entries.left() >= las_extra_bytes;) {
            at += add_extra_field(ByteReader(entries.read(las_extra_bytes)), at);
        }
        return at;
    }

    /// Adds an extra field; returns the number of bytes that it takes in a point.
    std::size_t add_extra_field(ByteReader entry, std::size_t at) {
        constexpr std::uint8_t has_scale = 8, has_offset = 16;
        entry.read(2);
        const auto code = entry.number<std::uint8_t>();
        const auto options = entry.number<std::uint8_t>();
        const std::string name = name_of(entry.text(std::uint64_t{32}));
        entry.read(4 + 3 * 24);         // reserved bytes; no-data, minimum and maximum values
        if (code == 0) return options;  // bytes without a defined type
        if (code > 3 * las_extra_types.size()) {
            throw Malformed(
                fmt::format("Extra Bytes {} are of unknown type {}", quote(name), code));
        }
        const FieldType type = las_extra_types[(code - 1) % las_extra_types.size()];
        const std::size_t count = 1 + (code - 1) / las_extra_types.size();
        std::array<double, 6> v{};
        for (double& value : v) value = entry.number<double>();
        const bool scaled = (options & (has_scale | has_offset)) != 0;
        const bool is_there = at + count * size_of(type) <= header_.record_bytes;
        for (std::size_t i = 0; i < count && is_there && !name.empty(); ++i) {
            LasField field = plain(count == 1 ? name : fmt::format("{}_{}", name, i), type,
                                   at + i * size_of(type));
            if (scaled) field.type = FieldType::f64;
            if ((options & has_scale) != 0) field.scale = v[i];
            if ((options & has_offset) != 0) field.offset = v[3 + i];
            header_.fields.push_back(std::move(field));
        }
        return count * size_of(type);
    }

    /// Uses exact Extra Bytes fields in place of the standard fields that they replace.
    void put_exact_in_place() {
        std::vector<LasField>& fields = header_.fields;
        for (std::size_t i = fields.size(); i-- > 0;) {
            if (!fields[i].name.ends_with(las_exact)) continue;
            const auto exact = fields.begin() + static_cast<std::ptrdiff_t>(i);
            const std::string name = exact->name.substr(0, exact->name.size() - las_exact.size());
            const auto rounded = std::find_if(
                fields.begin(), exact, [&](const LasField& field) { return field.name == name; });
            if (rounded == exact) continue;
            *rounded = *exact;
            rounded->name = name;
            fields.erase(exact);
        }
    }

    /// Returns `at`. Throws if the file ends before it.
    [[nodiscard]] std::size_t skip_to(std::size_t at) const {
        return ByteReader(bytes_).read(at).size();
    }

    std::span<const std::byte> bytes_;
    LasHeader header_;
    std::size_t header_size_ = 0;
    std::uint32_t records_ = 0;
    unsigned format_ = 0;
};

}  // namespace

LasHeader parse_las_header(std::span<const std::byte> bytes, const std::filesystem::path& file) {
    try {
        return LasHeaderParser(bytes).parse();
    } catch (const Malformed& error) {
        throw InputError(file, "header", error.what());
    }
}

}  // namespace dynamic_filter::io
