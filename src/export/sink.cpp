// SPDX-License-Identifier: MIT
#include "export/sink.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

bool is_dynamic(const Labels& labels, std::size_t i) {
    return !labels.empty() && labels[i] == Label::dynamic;
}

void require_labels(const Labels& labels, const std::string& output) {
    if (!labels.empty()) return;
    throw ConfigError(output +
                      " needs labels, to tell what stands from what moves: give --labels OUT, the "
                      "folder of a run");
}

std::string left_out(const std::vector<io::Field>& fields, const std::set<std::string>& kept,
                     const std::string& also) {
    std::vector<std::string> names;
    for (const io::Field& field : fields) {
        if (!kept.contains(field.name)) names.push_back(field.name);
    }
    if (!also.empty()) names.push_back(also);
    return names.empty() ? "" : fmt::format("left out: {}", fmt::join(names, ", "));
}

}  // namespace dynamic_filter::app
