// SPDX-License-Identifier: MIT
#include "formats/clouds/pcd_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

using Tokens = std::vector<std::string_view>;

constexpr std::uint64_t most_record_bytes = std::uint64_t{1} << 24U;

std::optional<FieldType> field_type(std::string_view type, std::string_view size) {
    static const std::map<std::string, FieldType> types = {
        {"I1", FieldType::i8},  {"I2", FieldType::i16}, {"I4", FieldType::i32},
        {"I8", FieldType::i64}, {"U1", FieldType::u8},  {"U2", FieldType::u16},
        {"U4", FieldType::u32}, {"U8", FieldType::u64}, {"F4", FieldType::f32},
        {"F8", FieldType::f64}};
    const auto found = types.find(std::string(type) + std::string(size));
    if (found == types.end()) return std::nullopt;
    return found->second;
}

std::string type_name(FieldType type) {
    switch (type) {
        case FieldType::i8:
        case FieldType::i16:
        case FieldType::i32:
        case FieldType::i64:
            return "I";
        case FieldType::f32:
        case FieldType::f64:
            return "F";
        default:
            return "U";
    }
}

/// Collects the lines of the header, then checks them together.
class PcdHeaderParser {
public:
    explicit PcdHeaderParser(Lines& lines) : lines_(lines) {}

    PcdHeader parse() {
        while (lines_.next()) {
            const Tokens tokens = split_tokens(lines_.line());
            if (tokens.empty() || tokens[0].starts_with('#')) continue;
            entry(std::string(tokens[0]), Tokens(tokens.begin() + 1, tokens.end()));
            if (tokens[0] == "DATA") return finish();
        }
        throw InputError(lines_.file(), "byte " + std::to_string(lines_.offset()),
                         "ends before the DATA line of its PCD header; the file is truncated");
    }

private:
    void entry(const std::string& key, const Tokens& arguments) {
        if (!seen_.insert(key).second) lines_.fail("a second " + quote(key) + " line");
        if (key == "FIELDS" || key == "COLUMNS")
            names_ = arguments;
        else if (key == "SIZE")
            sizes_ = arguments;
        else if (key == "TYPE")
            types_ = arguments;
        else if (key == "COUNT")
            read_counts(arguments);
        else if (key == "WIDTH")
            width_ = one_count(key, arguments);
        else if (key == "HEIGHT")
            height_ = one_count(key, arguments);
        else if (key == "POINTS")
            points_ = one_count(key, arguments);
        else if (key == "VIEWPOINT")
            read_viewpoint(arguments);
        else if (key == "DATA")
            read_data(arguments);
        else if (key != "VERSION")
            lines_.fail(quote(key) + " is no PCD header line");
    }

    std::uint64_t count_of(std::string_view token) const {
        const auto count = parse_count(token);
        if (!count) lines_.fail(quote(token) + " is no count; expected plain digits");
        return *count;
    }

    std::uint64_t one_count(const std::string& key, const Tokens& arguments) const {
        if (arguments.size() != 1) lines_.fail(key + " needs exactly one number");
        return count_of(arguments[0]);
    }

    void read_counts(const Tokens& arguments) {
        for (const auto token : arguments) {
            const std::uint64_t count = count_of(token);
            if (count > most_record_bytes) {
                lines_.fail("a COUNT of " + std::to_string(count) + " is not plausible");
            }
            counts_.push_back(static_cast<std::uint32_t>(count));
        }
    }

    void read_viewpoint(const Tokens& arguments) {
        const std::string order = "VIEWPOINT tx ty tz qw qx qy qz (wxyz)";
        std::array<double, 7> v{};
        if (arguments.size() != v.size()) lines_.fail("expected 7 numbers: " + order);
        for (std::size_t i = 0; i < v.size(); ++i) {
            const auto value = parse_real(arguments[i]);
            if (!value || !std::isfinite(*value)) {
                lines_.fail(quote(arguments[i]) + " is no finite number; expected " + order);
            }
            v[i] = *value;
        }
        const Pose pose = pose_from_quaternion(
            {v[0], v[1], v[2]}, Eigen::Quaterniond(v[3], v[4], v[5], v[6]), order, lines_);
        if (pose.matrix() != Pose::Identity().matrix()) header_.viewpoint = pose;
    }

    void read_data(const Tokens& arguments) {
        const std::string_view kind = arguments.empty() ? "" : arguments[0];
        if (kind == "ascii")
            header_.data = PcdData::ascii;
        else if (kind == "binary")
            header_.data = PcdData::binary;
        else if (kind == "binary_compressed")
            header_.data = PcdData::compressed;
        else
            lines_.fail("DATA " + quote(kind) + "; expected ascii, binary or binary_compressed");
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(lines_.file(), "header", what);
    }

    PcdHeader finish() {
        make_columns();
        count_points();
        return header_;
    }

    void make_columns() {
        if (names_.empty()) fail("has no FIELDS line");
        if (counts_.empty() && !seen_.contains("COUNT")) counts_.assign(names_.size(), 1);
        if (sizes_.size() != names_.size() || types_.size() != names_.size() ||
            counts_.size() != names_.size()) {
            fail(fmt::format("FIELDS, SIZE, TYPE and COUNT disagree: {}, {}, {} and {} entries",
                             names_.size(), sizes_.size(), types_.size(), counts_.size()));
        }
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const auto type = field_type(types_[i], sizes_[i]);
            if (!type) {
                fail("field " + quote(names_[i]) + " has TYPE " + quote(types_[i]) + " SIZE " +
                     quote(sizes_[i]) + "; known are I and U of 1, 2, 4, 8 and F of 4, 8");
            }
            add_column(std::string(names_[i]), *type, counts_[i]);
        }
        name_in_small_letters(header_.columns);
        if (record_bytes(header_.columns) > most_record_bytes) fail("a point of over 16 MiB");
    }

    void add_column(const std::string& name, FieldType type, std::uint32_t count) {
        const bool is_padding = name == "_";
        // Padding of no bytes, as PCL writes it, is no column.
        if (count == 0 && is_padding) return;
        if (count == 0) fail("field " + quote(name) + " has a COUNT of 0; expected 1 or more");
        header_.columns.push_back({name, type, count, is_padding});
    }

    void count_points() {
        if (!width_ && !points_) fail("has neither WIDTH nor POINTS");
        const auto area = product(width_.value_or(points_.value_or(0)), height_.value_or(1));
        if (!area) fail("WIDTH x HEIGHT overflows");
        header_.points = points_.value_or(*area);
        if (header_.points != *area) {
            fail(fmt::format("WIDTH x HEIGHT is {}, but POINTS is {}", *area, header_.points));
        }
    }

    Lines& lines_;
    PcdHeader header_;
    std::set<std::string> seen_;
    Tokens names_, sizes_, types_;
    std::vector<std::uint32_t> counts_;
    std::optional<std::uint64_t> width_, height_, points_;
};

}  // namespace

PcdHeader parse_pcd_header(Lines& lines) { return PcdHeaderParser(lines).parse(); }

std::string pcd_count(std::size_t count) { return fmt::format("{:<{}}", count, pcd_count_width); }

PcdHeaderText pcd_header_text(const std::vector<Field>& fields, std::size_t points,
                              const Pose& viewpoint, PcdData data) {
    constexpr std::array kinds = {"ascii", "binary", "binary_compressed"};
    std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
    for (const Field& field : fields) {
        names += " " + field.name;
        sizes += fmt::format(" {}", size_of(field.type));
        types += " " + type_name(field.type);
        counts += fmt::format(" {}", field.count);
    }
    PcdHeaderText header;
    header.text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + names + "\n" +
                  sizes + "\n" + types + "\n" + counts + "\nWIDTH ";
    header.width_at = header.text.size();
    const Eigen::Quaterniond q(viewpoint.linear());
    const Eigen::Vector3d t = viewpoint.translation();
    header.text += fmt::format("{}\nHEIGHT 1\nVIEWPOINT {} {} {} {} {} {} {}\nPOINTS ",
                               pcd_count(points), t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
    header.points_at = header.text.size();
    header.text += pcd_count(points) + "\nDATA " + kinds[static_cast<std::size_t>(data)] + "\n";
    return header;
}

}  // namespace dynamic_filter::io
