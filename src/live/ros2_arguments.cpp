// SPDX-License-Identifier: MIT
#include "live/ros2_arguments.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string_view>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::live {

namespace {

using Parameters = std::vector<app::Assignment>;

constexpr std::ptrdiff_t kMostTokens = 20;  // of a name; an alias can make a table part of itself

struct NodeName {
    std::string space = "/", name = "dynamicfilter";
    std::string whole() const { return (space == "/" ? "" : space) + "/" + name; }
};

/// What stands left and right of ":=".
std::pair<std::string, std::string> split(const std::string& option, const std::string& rule) {
    const auto sign = rule.find(":=");
    if (sign == std::string::npos || sign == 0) {
        throw ConfigError(fmt::format("'{} {}' must be NAME:=VALUE", option, rule));
    }
    return {rule.substr(0, sign), rule.substr(sign + 2)};
}

/// A YAML value as a setting is written.
std::string text_of_yaml(const YAML::Node& value) {
    if (value.IsNull()) return "";
    if (!value.IsScalar()) {
        throw YAML::Exception(value.Mark(), "is a list or a table, where one value is expected");
    }
    bool flag = false;
    const bool is_plain = value.Tag() == "?";  // not quoted
    if (is_plain && YAML::convert<bool>::decode(value, flag)) return flag ? "true" : "false";
    return value.Scalar();
}

bool concerns_the_library_of_ros(const std::string& name) {
    return name == "use_sim_time" || name == "start_type_description_service" ||
           name.starts_with("qos_overrides.");
}

void require_table(const YAML::Node& node) {
    if (!node.IsMap()) throw YAML::Exception(node.Mark(), "is no table of names and values");
}

/// Members of a table are named with a dot.
void add_parameter(Parameters& parameters, const std::string& name, const YAML::Node& value,
                   const std::string& file) {
    constexpr std::ptrdiff_t kDeepest = 10;  // tables; an alias can make a table part of itself
    if (value.IsMap() && std::count(name.begin(), name.end(), '.') < kDeepest) {
        for (const auto& member : value) {
            add_parameter(parameters, fmt::format("{}.{}", name, member.first.Scalar()),
                          member.second, file);
        }
    } else if (!concerns_the_library_of_ros(name)) {
        parameters.push_back(
            {name, text_of_yaml(value), fmt::format("{}: line {}", file, value.Mark().line + 1)});
    }
}

/// Whether a name with wildcards is that of the node: * stands for one token, ** for any number.
bool matches(std::string_view pattern, std::string_view name) {
    const auto token = [](std::string_view path) { return path.substr(0, path.find('/', 1)); };
    if (pattern.empty()) return name.empty();
    const std::string_view head = token(pattern), rest = pattern.substr(head.size());
    const std::string_view below = name.substr(token(name).size());
    if (head == "/**") return matches(rest, name) || (!name.empty() && matches(pattern, below));
    return !name.empty() && (head == "/*" || head == token(name)) && matches(rest, below);
}

/// The parameters of this node in a table of nodes, which may be nested in namespaces; `path` is
/// that of the table.
void add_nodes(Parameters& parameters, const YAML::Node& table, const std::string& path,
               const NodeName& node, const std::string& file) {
    for (const auto& entry : table) {
        const std::string key = entry.first.Scalar();
        if (key == "ros__parameters") {
            if (!matches(path, node.whole()) || entry.second.IsNull()) continue;
            require_table(entry.second);
            for (const auto& parameter : entry.second) {
                add_parameter(parameters, parameter.first.Scalar(), parameter.second, file);
            }
        } else if (entry.second.IsMap() &&
                   std::count(path.begin(), path.end(), '/') < kMostTokens) {
            add_nodes(parameters, entry.second, path + (key.starts_with('/') ? "" : "/") + key,
                      node, file);
        } else {
            throw YAML::Exception(
                entry.first.Mark(),
                fmt::format("'{}' stands outside of `ros__parameters`, below which ROS 2 expects "
                            "the parameters of a node",
                            key));
        }
    }
}

void add_file(Parameters& parameters, const std::string& file, const NodeName& node) {
    try {
        const YAML::Node root = YAML::LoadFile(file);
        if (root.IsNull()) return;
        require_table(root);
        add_nodes(parameters, root, "", node, file);
    } catch (const YAML::BadFile&) {
        throw ConfigError(fmt::format("{}: there is no such file of parameters", file));
    } catch (const YAML::Exception& error) {
        throw ConfigError(fmt::format("{}, line {}: {}", file, error.mark.line + 1, error.msg));
    }
}

/// What follows the name of a node and a colon; empty if it is for another node.
std::string for_this_node(const std::string& rule, const NodeName& node) {
    const auto colon = rule.find(':');
    if (colon == std::string::npos) return rule;
    const std::string given = rule.substr(0, colon);
    return given == node.name || given == NodeName{}.name ? rule.substr(colon + 1) : "";
}

/// A value is YAML here, too.
void add_given(Parameters& parameters, const std::string& rule, const NodeName& node) {
    const auto [whole, text] = split("-p", rule);
    const std::string name = for_this_node(whole, node);
    if (name.empty()) return;
    try {
        if (concerns_the_library_of_ros(name)) return;
        parameters.push_back({name, text_of_yaml(YAML::Load(text)), "-p " + rule});
    } catch (const YAML::Exception& error) {
        throw ConfigError(fmt::format("-p {}: {}", rule, error.msg));
    }
}

/// How the node is named, or else why a topic is not renamed so.
void remap(NodeName& node, const std::string& rule) {
    const auto [from, to] = split("-r", rule);
    const std::string what = for_this_node(from, node);
    if (what.empty()) return;
    if (what == "__node" || what == "__name") {
        node.name = to;
    } else if (what == "__ns") {
        node.space = to;
    } else {
        throw ConfigError(fmt::format(
            "'-r {}' renames a topic, which settings do here: -p input.cloud:=TOPIC for the scans, "
            "-p input.pose:=TOPIC for the poses, -p output.prefix:=/NAME for what is published",
            rule));
    }
}

}  // namespace

std::vector<app::Assignment> ros2_parameters(const std::vector<std::string>& words) {
    NodeName node;
    std::vector<std::string> given, files;
    for (auto word = words.begin(); word != words.end(); ++word) {
        const std::string option = *word;
        const auto value = [&]() -> const std::string& {
            if (std::next(word) == words.end()) {
                throw ConfigError(fmt::format("nothing follows '{}'", option));
            }
            return *++word;
        };
        if (option == "-p" || option == "--param") {
            given.push_back(value());
        } else if (option == "--params-file") {
            files.push_back(value());
        } else if (option == "-r" || option == "--remap") {
            remap(node, value());
        } else if (option == "--log-level" || option == "--log-config-file" ||
                   option == "--log-file-name" || option == "-e" || option == "--enclave") {
            value();
        } else if (!option.starts_with("--enable-") && !option.starts_with("--disable-")) {
            throw ConfigError(
                fmt::format("unknown argument '{}' after --ros-args; there may be -p NAME:=VALUE, "
                            "--params-file FILE, -r __node:=NAME and -r __ns:=/NAMESPACE",
                            option));
        }
    }
    Parameters parameters;
    if (!words.empty()) parameters.push_back({"output.prefix", node.whole(), "name of the node"});
    for (const std::string& file : files) add_file(parameters, file, node);
    for (const std::string& rule : given) add_given(parameters, rule, node);
    return parameters;
}

}  // namespace dynamic_filter::live
