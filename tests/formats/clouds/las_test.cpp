// SPDX-License-Identifier: MIT
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace las_test {

constexpr std::size_t header_bytes = 227;

std::string filled(const std::string& text, std::size_t width) {
    return text + std::string(width - text.size(), '\0');
}

template <class T>
void overwrite(std::string& bytes, std::size_t at, T value) {
    bytes.replace(at, sizeof value, bytes_of(value));
}

/// LAS 1.2, scale 0.5, offset (100, 200, 300).
std::string header(unsigned format, unsigned stride, std::uint32_t points,
                   const std::string& records = "", std::uint32_t record_count = 0) {
    std::string bytes(header_bytes, '\0');
    bytes.replace(0, 4, "LASF");
    bytes[24] = 1;
    bytes[25] = 2;
    overwrite(bytes, 94, static_cast<std::uint16_t>(header_bytes));
    overwrite(bytes, 96, static_cast<std::uint32_t>(header_bytes + records.size()));
    overwrite(bytes, 100, record_count);
    overwrite(bytes, 104, static_cast<std::uint8_t>(format));
    overwrite(bytes, 105, static_cast<std::uint16_t>(stride));
    overwrite(bytes, 107, points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        overwrite(bytes, 131 + 8 * axis, 0.5);
        overwrite(bytes, 155 + 8 * axis, 100.0 * static_cast<double>(axis + 1));
    }
    return bytes + records;
}

std::string start(std::int32_t x, std::uint16_t intensity) {
    return bytes_of(x) + bytes_of(x + 2) + bytes_of(x + 4) + bytes_of(intensity);
}

/// Return 2 of 3; class 5 with the synthetic flag; -10 degrees; user data 9; source 77.
std::string old_point(std::int32_t x) {
    return start(x, 500) + "\x1a\x25\xf6\x09" + bytes_of(std::uint16_t{77});
}

std::string colours() {
    return bytes_of(std::uint16_t{1}) + bytes_of(std::uint16_t{2}) + bytes_of(std::uint16_t{3});
}

std::string extra(std::uint8_t type, std::uint8_t options, const std::string& name) {
    std::string entry = std::string(2, '\0') + bytes_of(type) + bytes_of(options);
    entry += filled(name, 32) + std::string(4 + 72, '\0');
    for (const double scale : {0.25, 0.5, 1.0}) entry += bytes_of(scale);
    for (const double offset : {10.0, 20.0, 30.0}) entry += bytes_of(offset);
    return entry + std::string(32, '\0');
}

std::string extra_record(const std::string& entries, std::uint16_t id = 4) {
    return std::string(2, '\0') + filled("LASF_Spec", 16) + bytes_of(id) +
           bytes_of(static_cast<std::uint16_t>(entries.size())) + std::string(32, '\0') + entries;
}

class Las : public testing::Test {
protected:
    Cloud read(const std::string& bytes) { return read_cloud(folder_.put("a.las", bytes)); }
    std::string error(const std::string& bytes) {
        return error_of([&] { read(bytes); });
    }
    TemporaryFolder folder_;
};

using Numbers = std::vector<double>;

TEST_F(Las, OldFormats) {
    const Cloud cloud = read(header(0, 20, 2) + old_point(0) + old_point(-1));
    EXPECT_EQ(column(cloud, "x"), (Numbers{100, 99.5}));
    EXPECT_EQ(column(cloud, "y"), (Numbers{201, 200.5}));
    EXPECT_EQ(column(cloud, "z"), (Numbers{302, 301.5}));
    EXPECT_EQ(cloud.find("x")->type, FieldType::f64);
    EXPECT_EQ(column(cloud, "intensity"), (Numbers{500, 500}));
    EXPECT_EQ(column(cloud, "return_number").at(0), 2);
    EXPECT_EQ(column(cloud, "number_of_returns").at(0), 3);
    EXPECT_EQ(column(cloud, "classification").at(0), 5);
    EXPECT_EQ(column(cloud, "scan_angle").at(0), -10);
    EXPECT_EQ(column(cloud, "user_data").at(0), 9);
    EXPECT_EQ(column(cloud, "point_source_id").at(0), 77);
    EXPECT_EQ(cloud.find("gps_time"), nullptr);
    EXPECT_EQ(cloud.find("red"), nullptr);
    const Cloud timed = read(header(3, 34, 1) + old_point(0) + bytes_of(1.25) + colours());
    EXPECT_EQ(column(timed, "gps_time").at(0), 1.25);
    EXPECT_EQ(column(timed, "blue").at(0), 3);
    const Cloud coloured = read(header(2, 26, 1) + old_point(0) + colours());
    EXPECT_EQ(column(coloured, "red").at(0), 1);
    EXPECT_EQ(read(header(5, 63, 1) + std::string(63, '\0')).fields.size(), 14U);
}

TEST_F(Las, NewFormats) {
    const std::string point = start(0, 7) + std::string("\x21\x00\xc8\x04", 4) +
                              bytes_of(std::int16_t{-500}) + bytes_of(std::uint16_t{8}) +
                              bytes_of(2.5);
    const Cloud cloud = read(header(8, 38, 1) + point + colours() + bytes_of(std::uint16_t{4}));
    EXPECT_EQ(column(cloud, "return_number").at(0), 1);
    EXPECT_EQ(column(cloud, "number_of_returns").at(0), 2);
    EXPECT_EQ(column(cloud, "classification").at(0), 200);
    EXPECT_FLOAT_EQ(static_cast<float>(column(cloud, "scan_angle").at(0)), -3.0F);
    EXPECT_EQ(column(cloud, "gps_time").at(0), 2.5);
    EXPECT_EQ(column(cloud, "green").at(0), 2);
    EXPECT_EQ(column(cloud, "nir").at(0), 4);
    EXPECT_EQ(read(header(10, 67, 1) + std::string(67, '\0')).find("nir")->offset,
              read(header(8, 38, 1) + std::string(38, '\0')).find("nir")->offset);
}

TEST_F(Las, ExtraBytes) {
    const std::string records =
        extra_record("other", 9) + extra_record(extra(3, 0, "Pulse width") + extra(0, 2, "bytes") +
                                                extra(1, 24, "scaled") + extra(12, 0, "pair"));
    const std::string point =
        old_point(0) + bytes_of(std::uint16_t{999}) + "??" + "\x08" + "\xff" + "\x01" + "unused";
    const Cloud cloud = read(header(0, static_cast<unsigned>(point.size()), 1, records, 2) + point);
    EXPECT_EQ(column(cloud, "Pulse_width"), Numbers{999});
    EXPECT_EQ(column(cloud, "scaled"), Numbers{12});
    EXPECT_EQ(column(cloud, "pair_0"), Numbers{-1});
    EXPECT_EQ(column(cloud, "pair_1"), Numbers{1});
    EXPECT_EQ(cloud.find("bytes"), nullptr);
    const std::string twice = extra_record(extra(1, 0, "a")) + extra_record(extra(1, 0, "b"));
    EXPECT_EQ(read(header(0, 21, 1, twice, 2) + old_point(0) + "a").find("b"), nullptr);
    const auto one = [&](const std::string& entries) {
        return error(header(0, 21, 1, extra_record(entries), 1) + old_point(0) + "a");
    };
    // RIEGL's programs describe fields that are not there.
    const std::string beyond = extra_record(extra(1, 0, "a") + extra(3, 0, "wide"));
    const Cloud lean = read(header(0, 21, 1, beyond, 1) + old_point(0) + "a");
    EXPECT_EQ(column(lean, "a"), Numbers{'a'});
    EXPECT_EQ(lean.find("wide"), nullptr);
    EXPECT_EQ(column(read(header(0, 22, 1, twice, 2) + old_point(0) + "ab"), "b"), Numbers{'b'});
    EXPECT_HAS(one(extra(99, 0, "odd")), "unknown type 99");
    EXPECT_HAS(one(extra(1, 0, "intensity")), "two fields");
}

/// Only what stands for a standard field takes its place, wherever others of such names are.
TEST_F(Las, ExactValues) {
    const std::string records = extra_record(extra(1, 0, "own_exact") + extra(1, 0, "own") +
                                             extra(9, 0, "user_data_exact") + extra(1, 0, "last"));
    const std::string point = old_point(0) + "\x01\x02" + floats({0.5F}) + "\x03";
    const Cloud cloud = read(header(0, static_cast<unsigned>(point.size()), 1, records, 1) + point);
    EXPECT_EQ(column(cloud, "user_data"), Numbers{0.5});
    EXPECT_EQ(column(cloud, "own_exact"), Numbers{1});
    EXPECT_EQ(column(cloud, "own"), Numbers{2});
    EXPECT_EQ(column(cloud, "last"), Numbers{3});
    EXPECT_EQ(cloud.find("user_data_exact"), nullptr);
}

TEST_F(Las, Refusals) {
    EXPECT_HAS(error("PCD"), "byte 3");
    EXPECT_HAS(error("#las " + std::string(300, ' ')), "LASF");
    EXPECT_HAS(error(header(128, 20, 1) + old_point(0)), "compressed LAZ is not read");
    EXPECT_HAS(error(header(11, 80, 1)), "point format 11");
    EXPECT_HAS(error(header(1, 20, 1)), "20 bytes");
    EXPECT_HAS(error(header(0, 20, 2) + old_point(0)), "1 of 2 points");
    EXPECT_HAS(error(header(0, 20, 4294967295U) + old_point(0)), "1 of 4294967295");
    EXPECT_HAS(error(header(0, 20, 0, "", 4294967295U)), "ends at byte");
    std::string later = header(0, 20, 0);
    later[25] = 5;
    EXPECT_HAS(error(later), "LAS 1.5");
    std::string infinite = header(0, 20, 0);
    overwrite(infinite, 131, std::numeric_limits<double>::infinity());
    EXPECT_HAS(error(infinite), "not finite");
    std::string flat = header(0, 20, 0);
    overwrite(flat, 139, 0.0);
    EXPECT_HAS(error(flat), "scale is 0");
    std::string short_header = header(0, 20, 0) + std::string(300, '\0');
    short_header[25] = 4;
    EXPECT_HAS(error(short_header), "behind a header of 227");
    std::string far = header(0, 20, 1) + old_point(0);
    overwrite(far, 96, 4294967295U);
    EXPECT_HAS(error(far), "4294967295");
}

Cloud sample(std::size_t points) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity"}) add_field(cloud, name, FieldType::f32);
    add_field(cloud, "return_number", FieldType::u8);
    add_field(cloud, "gps_time", FieldType::f64);
    add_field(cloud, "dynamic", FieldType::u8);
    add_field(cloud, "normal", FieldType::f32, 2);
    for (std::size_t i = 0; i < points; ++i) {
        const auto n = static_cast<float>(i);
        const std::string record = floats({n, -n, 0.125F * n, 0.1F * n}) +
                                   bytes_of(static_cast<std::uint8_t>(i + 1)) +
                                   bytes_of(1e9 + static_cast<double>(i)) +
                                   bytes_of(static_cast<std::uint8_t>(i % 2)) + floats({n, 2 * n});
        const auto raw = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), raw.begin(), raw.end());
    }
    return cloud;
}

TEST_F(Las, RoundTrip) {
    const Cloud cloud = sample(5);
    EXPECT_HAS(write_las(folder_ / "w.las", cloud).loss, "1 mm");
    const Cloud back = read_las(folder_ / "w.las");
    ASSERT_EQ(back.size(), 5U);
    for (const char* name : {"x", "y", "z"}) {
        const Numbers a = column(cloud, name), b = column(back, name);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.00051);
    }
    for (const char* name : {"intensity", "return_number", "gps_time", "dynamic"}) {
        EXPECT_EQ(column(back, name), column(cloud, name)) << name;
        EXPECT_EQ(back.find(name)->type, cloud.find(name)->type) << name;
    }
    EXPECT_EQ(column(back, "normal_1"), (Numbers{0, 2, 4, 6, 8}));
}

TEST_F(Las, KeepsTheCoordinateSystemAndWhatTimesCountFrom) {
    Cloud cloud = sample(5);
    EXPECT_EQ(read_las(folder_.put("none.las", header(0, 20, 0))).crs, "");
    cloud.crs = "PROJCS[\"a system\"]";
    cloud.gps_time_is_adjusted = true;
    write_las(folder_ / "w.las", cloud);
    const Cloud back = read_las(folder_ / "w.las");
    EXPECT_EQ(back.crs, cloud.crs);
    EXPECT_TRUE(back.gps_time_is_adjusted);
    EXPECT_EQ(column(back, "normal_1"), (Numbers{0, 2, 4, 6, 8})) << "Extra Bytes are read, too";
    cloud.crs = std::string(70000, 'x');
    EXPECT_HAS(error_of<OutputError>([&] { write_las(folder_ / "v.las", cloud); }), "65,535");
}

TEST_F(Las, GeoTiffKeysNameASystemByItsCode) {
    const auto file_of = [&](std::uint16_t code, std::uint16_t place = 0) {
        // Versions and number of keys; the type of the model; the projected system.
        const std::vector<std::uint16_t> numbers = {1, 1, 0,    2,     1024, 0,
                                                    1, 1, 3072, place, 1,    code};
        std::string keys;
        for (const std::uint16_t number : numbers) keys += bytes_of(number);
        const std::string record =
            std::string(2, '\0') + filled("LASF_Projection", 16) + bytes_of(std::uint16_t{34735}) +
            bytes_of(static_cast<std::uint16_t>(keys.size())) + std::string(32, '\0') + keys;
        return header(0, 20, 1, record, 1) + old_point(0);
    };
    const Cloud cloud = read(file_of(25832));
    EXPECT_EQ(cloud.crs, "EPSG:25832");
    EXPECT_HAS(write_las(folder_ / "w.las", cloud).loss, "--crs EPSG:25832");
    EXPECT_EQ(read_las(folder_ / "w.las").crs, "") << "a code is no WKT";
    EXPECT_EQ(read(file_of(32767)).crs, "") << "user-defined";
    EXPECT_EQ(read(file_of(25832, 34736)).crs, "") << "not in this record";
}

/// The standard intensities and classes, as a reader without Extra Bytes sees them.
std::pair<Numbers, Numbers> shown_by_others(const std::string& bytes) {
    std::uint32_t begin = 0;
    std::uint16_t stride = 0;
    std::uint64_t points = 0;
    std::memcpy(&begin, bytes.data() + 96, sizeof begin);
    std::memcpy(&stride, bytes.data() + 105, sizeof stride);
    std::memcpy(&points, bytes.data() + 247, sizeof points);
    std::pair<Numbers, Numbers> shown;
    for (std::uint64_t i = 0; i < points; ++i) {
        const char* const record = bytes.data() + begin + i * stride;
        std::uint16_t intensity = 0;
        std::memcpy(&intensity, record + 12, sizeof intensity);
        shown.first.push_back(intensity);
        shown.second.push_back(static_cast<unsigned char>(record[16]));
    }
    return shown;
}

/// Writes points with these intensities; every second one is dynamic.
std::pair<std::string, std::string> with_intensities(const std::filesystem::path& file,
                                                     const std::vector<float>& intensities) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity"}) add_field(cloud, name, FieldType::f32);
    add_field(cloud, "dynamic", FieldType::u8);
    for (std::size_t i = 0; i < intensities.size(); ++i) {
        const std::string record =
            floats({1, 2, 3, intensities[i]}) + bytes_of(static_cast<std::uint8_t>(i % 2));
        const auto raw = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), raw.begin(), raw.end());
    }
    return {write_las(file, cloud).loss, slurp(file)};
}

TEST_F(Las, OtherProgramsSeeIntensitiesAndWhatMoved) {
    const auto [loss, bytes] = with_intensities(folder_ / "w.las", {0.0F, 0.5F, 1.0F, -0.5F});
    EXPECT_HAS(loss, "65535 times");
    const auto [intensities, classes] = shown_by_others(bytes);
    EXPECT_EQ(intensities, (Numbers{0, 32768, 65535, 0}));
    EXPECT_EQ(classes, (Numbers{1, 22, 1, 22}));
    EXPECT_EQ(column(read_las(folder_ / "w.las"), "intensity"), (Numbers{0, 0.5, 1, -0.5}))
        << "the given values are in Extra Bytes";
}

TEST_F(Las, IntensitiesAreScaledOnlyWhereTheyMustBe) {
    const auto plain = with_intensities(folder_ / "p.las", {0.0F, 12.4F, 255.0F});
    EXPECT_EQ(plain.first.find("times"), std::string::npos);
    EXPECT_EQ(shown_by_others(plain.second).first, (Numbers{0, 12, 255}));
    const auto one = with_intensities(folder_ / "o.las", {0.0F, 1.0F});
    EXPECT_EQ(shown_by_others(one.second).first, (Numbers{0, 1})) << "counts, not fractions";
    const auto large = with_intensities(folder_ / "l.las", {0.0F, 131070.0F, NAN});
    EXPECT_HAS(large.first, "0.5 times");
    EXPECT_EQ(shown_by_others(large.second).first, (Numbers{0, 65535, 0}));
}

TEST_F(Las, BoundsAreThoseOfTheCoordinatesAsWritten) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
    const std::string points = floats({0.12345F, 1.0F, 2.0F, 9.87654F, 1.0F, 2.0F});
    const auto raw = std::as_bytes(std::span(points));
    cloud.data.assign(raw.begin(), raw.end());
    write_las(folder_ / "w.las", cloud);
    const std::string bytes = slurp(folder_ / "w.las");
    double bounds[2] = {};  // the greatest x, the least
    std::memcpy(bounds, bytes.data() + 179, sizeof bounds);
    EXPECT_EQ(column(read_las(folder_ / "w.las"), "x"), (Numbers{bounds[1], bounds[0]}));
}

TEST_F(Las, FarFromTheOrigin) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f64);
    const auto put = [&](double x) {
        const std::string record = bytes_of(x) + bytes_of(5e6) + bytes_of(-1e6);
        const auto raw = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), raw.begin(), raw.end());
    };
    for (const double x : {691234.567, 691235.0, std::nan("")}) put(x);
    EXPECT_HAS(write_las(folder_ / "w.las", cloud).loss, "1 points that are not finite");
    EXPECT_NEAR(column(read_las(folder_ / "w.las"), "x").at(0), 691234.567, 1e-9);
    put(1e9);
    EXPECT_HAS(error_of<OutputError>([&] { write_las(folder_ / "v.las", cloud); }), "wider");
    cloud.data.clear();
    write_las(folder_ / "w.las", cloud);
    EXPECT_EQ(read_las(folder_ / "w.las").size(), 0U);
}

TEST_F(Las, WhatDoesNotFit) {
    Cloud cloud = sample(0);
    add_field(cloud, std::string(33, 'n'), FieldType::u8);
    EXPECT_HAS(error_of<OutputError>([&] { write_las(folder_ / "w.las", cloud); }),
               "32 characters");
    Cloud wide = sample(0);
    add_field(wide, "many", FieldType::u8, 400);
    EXPECT_HAS(error_of<OutputError>([&] { write_las(folder_ / "w.las", wide); }), "more than");
    EXPECT_HAS(error_of<OutputError>([&] { write_las(folder_ / "w.las", Cloud{}); }), "'x'");
}

TEST_F(Las, TruncatedAnywhere) {
    write_las(folder_ / "w.las", sample(3));
    const std::string bytes = slurp(folder_ / "w.las");
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        EXPECT_THROW(read(bytes.substr(0, n)), InputError) << n;
    }
}

TEST_F(Las, DamagedAnywhere) {
    write_las(folder_ / "w.las", sample(2));
    const std::string bytes = slurp(folder_ / "w.las");
    const Cloud whole = read(bytes);
    std::uint32_t points_at = 0;
    std::memcpy(&points_at, &bytes[96], sizeof points_at);
    std::uint16_t record = 0;
    std::memcpy(&record, &bytes[105], sizeof record);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        std::string damaged = bytes;
        damaged[n] = static_cast<char>(~damaged[n]);
        if (n >= points_at) {  // LAS has no checksums: the other point is as it was
            const Cloud back = read(damaged);
            ASSERT_EQ(back.size(), 2U) << n;
            const std::size_t other = n < points_at + record ? 1 : 0;
            EXPECT_TRUE(std::equal(back.data.begin() + other * back.point_bytes,
                                   back.data.begin() + (other + 1) * back.point_bytes,
                                   whole.data.begin() + other * whole.point_bytes))
                << n;
            continue;
        }
        try {
            EXPECT_LE(read(damaged).size(), 2U);
        } catch (const InputError& e) {
            EXPECT_HAS(std::string(e.what()), "a.las");
        }
    }
}

TEST_F(Las, CountsOf64Bits) {
    write_las(folder_ / "w.las", sample(2));
    for (const std::uint64_t count : {std::uint64_t{1} << 63U, ~std::uint64_t{0}}) {
        std::string bytes = slurp(folder_ / "w.las");
        overwrite(bytes, 247, count);
        EXPECT_HAS(error(bytes), "2 of " + std::to_string(count));
    }
    std::string old_count = slurp(folder_ / "w.las");
    overwrite(old_count, 107, std::uint32_t{2});
    overwrite(old_count, 247, std::uint64_t{0});
    EXPECT_EQ(read(old_count).size(), 2U);
}

}  // namespace las_test
}  // namespace dynamic_filter::io
