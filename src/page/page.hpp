// SPDX-License-Identifier: MIT
/// The viewer's page with data filled in (viewer/README.md is the contract).
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter::app {

/// The page as it was built in, or empty: built without viewer/node_modules.
std::string_view viewer_page();

/// Numbers of one type, little endian, as rows of columns.
struct PageArray {
    std::string name, type;  ///< "map-position", "uint16"
    std::size_t columns = 1, rows = 0;
    std::string bytes;
};

template <class T>
constexpr const char* page_type() {
    if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<T, std::int32_t>) return "int32";
    if constexpr (std::is_same_v<T, float>) return "float32";
    if constexpr (std::is_same_v<T, double>) return "float64";
}

template <class T>
PageArray page_array(std::string name, std::size_t columns, const std::vector<T>& values) {
    PageArray array{std::move(name), page_type<T>(), columns, values.size() / columns, {}};
    array.bytes.resize(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(array.bytes.data(), values.data(), array.bytes.size());
    return array;
}

/// One run (or cloud) on the page.
struct PageRun {
    nlohmann::ordered_json info;  ///< without `arrays`
    std::vector<PageArray> arrays;
};

/// A run as text between the tags of a page; `number` counts from 0.
std::string embedded(const PageRun& run, std::size_t number);

/// The page with these runs, each from embedded(). Throws Error if there is no page.
std::string page_with(std::span<const std::string> runs);

/// The page in parts, for many pages in one folder: each refers to viewer.js and viewer.css beside
/// it, which hold by far the most of the page, and which a browser loads from the disk, too.
struct SharedPage {
    std::string style, script;  ///< contents of viewer.css and viewer.js

    /// The page with this run, from embedded().
    [[nodiscard]] std::string with(const std::string& run) const;

    std::string before, after;  ///< of the data
};

/// Throws Error if there is no page.
SharedPage shared_page();

/// The run of a report, to be embedded in another page as number `number`. Throws InputError if the
/// file is no report of this version.
std::string run_of_report(const std::filesystem::path& file, std::size_t number);

}  // namespace dynamic_filter::app
