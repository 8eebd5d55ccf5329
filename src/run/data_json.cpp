// SPDX-License-Identifier: MIT
#include "run/data_json.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void add(Json& json, const char* name, const std::optional<fs::path>& value) {
    if (value) json[name] = *value == kNoPoses ? kNoPoses : full_path(*value);
}

void add(Json& json, const char* name, const std::optional<std::size_t>& value) {
    if (value) json[name] = *value;
}

template <class T>
void add(Json& json, const char* name, const T& value) {
    json[name] = value;
}

template <class T>
void find(const Json& json, const char* name, T& value) {
    json.at(name).get_to(value);
}

void find(const Json& json, const char* name, std::optional<fs::path>& value) {
    if (json.contains(name)) value = json[name].get<std::string>();
}

void find(const Json& json, const char* name, std::optional<std::size_t>& value) {
    if (json.contains(name)) value = json[name].get<std::size_t>();
}

}  // namespace

std::string full_path(const fs::path& path) {
    return fs::absolute(path).lexically_normal().string();
}

Json json_of(const DataOptions& options) {
    Json json;
    visit_reading(options, [&](const ReadingOption& option, const auto& value) {
        add(json, option.name, value);
    });
    return json;
}

DataOptions data_options_of(const Json& json) {
    DataOptions options;
    visit_reading(
        options, [&](const ReadingOption& option, auto& value) { find(json, option.name, value); });
    refuse_invalid(options, Asker::command);
    return options;
}

}  // namespace dynamic_filter::app
