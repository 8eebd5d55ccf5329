// SPDX-License-Identifier: MIT
#include "commands/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/edit_distance.hpp"
#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

namespace {

using Words = std::vector<std::string>;

/// How `--help` shows a choice; the completion of shells reads it there.
std::string one_of(const Words& choices) { return fmt::format("{{{}}}", fmt::join(choices, ",")); }

std::string number_text(double value) { return fmt::format("{:.15g}", value); }

/// What a number must be.
std::string bounds_text(const char* kind, const Bounds& bounds, bool is_bounded) {
    if (!is_bounded) return fmt::format("{} of {} or more", kind, number_text(bounds.low));
    return fmt::format("{} from {} to {}", kind, number_text(bounds.low), number_text(bounds.high));
}

[[noreturn]] void refuse(const CLI::Option& option, const std::string& text,
                         const std::string& expected) {
    throw CLI::ValidationError(option.get_name(), fmt::format("'{}' is no {}", text, expected));
}

/// Adds an option whose last word goes to `set`.
CLI::Option& add(CLI::App& app, const char* names, const char* type, const std::string& standard,
                 const std::string& what,
                 const std::function<void(const CLI::Option&, const std::string&)>& set) {
    // The callback needs the option, which is made with it.
    const auto self = std::make_shared<CLI::Option*>(nullptr);
    CLI::Option* const option = app.add_option(
        names,
        [self, set](const CLI::results_t& words) {
            set(**self, words.back());
            return true;
        },
        what);
    *self = option;
    option->type_name(type);
    if (!standard.empty()) option->default_str(standard);
    return *option;
}

CLI::Option& add_many(CLI::App& app, const char* names, const char* type, const std::string& what,
                      const std::function<void(const Words&)>& set) {
    CLI::Option* const option = app.add_option(
        names,
        [set](const CLI::results_t& words) {
            set(words);
            return true;
        },
        what);
    option->type_name(type);
    return *option;
}

/// `alone` stands for an option without a word.
CLI::Option& add_choice(CLI::App& app, const char* names, std::string& value, const Words& choices,
                        const std::string& what, const std::string& alone = "") {
    CLI::Option& option = add(
        app, names, "", value, what,
        [&value, choices, alone](const CLI::Option& self, const std::string& given) {
            const std::string& word = given.empty() ? alone : given;
            if (std::find(choices.begin(), choices.end(), word) == choices.end()) {
                throw CLI::ValidationError(self.get_name(), fmt::format("'{}' is none of {}", word,
                                                                        fmt::join(choices, ", ")));
            }
            value = word;
        });
    option.type_name(one_of(choices));
    return option;
}

void set_number(double& value, const Bounds& bounds, const CLI::Option& option,
                const std::string& word) {
    double given = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, given);
    if (error != std::errc{} || stop != end || !(given >= bounds.low && given <= bounds.high)) {
        refuse(option, word, bounds_text("number", bounds, true));
    }
    value = given;
}

std::string did_you_mean(const std::string& given, const Words& known) {
    const std::string nearest = nearest_word(given, known);
    return nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest);
}

/// Options by which other programs call what is a setting or an argument here.
std::string known_elsewhere(const std::string& name) {
    static const std::map<std::string, const char*> answers = {
        {"--voxel-size", "the size of a voxel is a setting: --set map.voxel_size=0.1"},
        {"--voxel_size", "the size of a voxel is a setting: --set map.voxel_size=0.1"},
        {"--resolution", "the size of a voxel is a setting: --set map.voxel_size=0.1"},
        {"--leaf-size", "the size of a voxel is a setting: --set map.voxel_size=0.1"},
        {"--input", "the recording is given without an option: dynamicfilter run RECORDING"},
        {"-i", "the recording is given without an option: dynamicfilter run RECORDING"},
        {"--data", "the recording is given without an option: dynamicfilter run RECORDING"},
        {"--out", "the output is given by -o"},
        {"--output-dir", "the output is given by -o"},
        {"--force", "an existing output is replaced by --overwrite"},
        {"-f", "an existing output is replaced by --overwrite"},
        {"-j", "the number of threads is given by --threads"},
        {"--jobs", "the number of threads is given by --threads"},
        {"--verbose", "everything is printed already; --quiet prints less"},
        {"-v",
         "everything is printed already; --quiet prints less, and --version is an option of its "
         "own"},
    };
    const auto answer = answers.find(name);
    return answer == answers.end() ? "" : std::string(": ") + answer->second;
}

/// CLI11 would only ask for a subcommand.
void refuse_unknown_command(const CLI::App& app, std::span<char* const> arguments) {
    const std::string given = arguments.size() > 1 ? arguments[1] : "-";
    Words known;
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    if (known.empty() || given.starts_with('-') ||
        std::find(known.begin(), known.end(), given) != known.end()) {
        return;
    }
    throw ConfigError(fmt::format("unknown command '{}'{}; the commands are: {}", given,
                                  did_you_mean(given, known), fmt::join(known, ", ")));
}

/// CLI11 names what it did not expect, but not what may have been meant.
[[noreturn]] void refuse_unknown_options(const CLI::App& app) {
    const auto given_commands = app.get_subcommands();
    const CLI::App& command = given_commands.empty() ? app : *given_commands.front();
    Words known;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    std::string text;
    for (const std::string& given : app.remaining(true)) {
        const bool is_option = given.starts_with('-');
        if (!text.empty() && !is_option) continue;  // the value of an unknown option
        const std::string name = given.substr(0, given.find('='));
        std::string hint = is_option ? known_elsewhere(name) : "";
        if (is_option && hint.empty()) hint = did_you_mean(name, known);
        text += fmt::format("{}unknown {} '{}'{}", text.empty() ? "" : "; ",
                            is_option ? "option" : "argument", name, hint);
    }
    if (given_commands.empty() && !app.get_subcommands({}).empty()) {
        throw ConfigError(
            text + "; options come after a command, and `dynamicfilter --help` lists the commands");
    }
    throw ConfigError(fmt::format(
        "{}; `{} --help` lists the options", text,
        given_commands.empty() ? app.get_name() : app.get_name() + " " + command.get_name()));
}

/// What CLI11 says of wrong arguments, in the form of all other errors.
std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    const auto commands = app->get_subcommands();
    const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
    const bool lists_commands = commands.empty() && !app->get_subcommands({}).empty();
    return fmt::format("{}: {}; `{} {}--help` lists the {}\n", app->get_name(), error.what(),
                       app->get_name(), command, lists_commands ? "commands" : "options");
}

/// Puts aside what another kind of arguments are.
std::vector<char*> without_rest(std::span<char* const> arguments, const Command::Shared& shared) {
    const bool has_rest =
        shared.rest != nullptr && arguments.size() > 1 && arguments[1] == shared.rest_of;
    std::vector<char*> own;
    bool is_rest = false;
    for (char* const argument : arguments) {
        const std::string_view word = argument;
        if (has_rest && word == shared.rest_mark) {
            is_rest = true;
        } else if (is_rest && word == "--") {
            is_rest = false;
        } else if (is_rest) {
            shared.rest->emplace_back(word);
        } else {
            own.push_back(argument);
        }
    }
    return own;
}

}  // namespace

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option Command::text(const char* names, std::string& value, const std::string& what) {
    return Option(add(*app_, names, "TEXT", value, what,
                      [&value](const auto&, const auto& word) { value = word; }));
}

Option Command::path(const char* names, std::filesystem::path& value, const std::string& what) {
    return Option(add(*app_, names, "PATH", value.string(), what,
                      [&value](const auto&, const auto& word) { value = word; }));
}

Option Command::path(const char* names, std::optional<std::filesystem::path>& value,
                     const std::string& what) {
    return Option(add(*app_, names, "PATH", "", what,
                      [&value](const auto&, const auto& word) { value = word; }));
}

Option Command::paths(const char* names, std::vector<std::filesystem::path>& values,
                      const std::string& what, int most) {
    CLI::Option& option = add_many(*app_, names, "PATH", what, [&values](const Words& words) {
        values.assign(words.begin(), words.end());
    });
    option.expected(1, most > 0 ? most : CLI::detail::expected_max_vector_size)->allow_extra_args();
    return Option(option);
}

Option Command::words(const char* names, std::vector<std::string>& values,
                      const std::string& what) {
    CLI::Option& option =
        add_many(*app_, names, "TEXT", what, [&values](const Words& words) { values = words; });
    option.take_all()->expected(1);
    return Option(option);
}

Option Command::choice(const char* names, std::string& value, const Words& choices,
                       const std::string& what) {
    return Option(add_choice(*app_, names, value, choices, what));
}

Option Command::choice_or(const char* names, std::string& value, const Words& choices,
                          const std::string& alone, const std::string& what) {
    CLI::Option& option = add_choice(*app_, names, value, choices, what, alone);
    option.expected(0, 1);
    return Option(option);
}

Option Command::flag(const char* names, bool& value, const std::string& what) {
    return Option(*app_->add_flag(names, value, what));
}

Option Command::number(const char* names, double& value, Bounds bounds, const std::string& what) {
    const std::string standard = value != 0.0 && std::isfinite(value) ? number_text(value) : "";
    return Option(add(*app_, names, "NUMBER", standard, what,
                      [&value, bounds](const auto& option, const auto& word) {
                          set_number(value, bounds, option, word);
                      }));
}

Option Command::whole(const char* names, const std::function<void(std::uint64_t)>& set,
                      std::optional<std::uint64_t> standard, Bounds bounds,
                      const std::string& what) {
    const std::string shown = standard.value_or(0) > 0 ? std::to_string(*standard) : "";
    return Option(add(*app_, names, "NUMBER", shown, what,
                      [set, bounds](const auto& option, const std::string& word) {
                          std::uint64_t given = 0;
                          const char* const end = word.data() + word.size();
                          const auto [stop, error] = std::from_chars(word.data(), end, given);
                          const bool is_bounded = bounds.high > 0.0;
                          const auto at = static_cast<double>(given);
                          if (error != std::errc{} || stop != end || at < bounds.low ||
                              (is_bounded && at > bounds.high)) {
                              refuse(option, word, bounds_text("whole number", bounds, is_bounded));
                          }
                          set(given);
                      }));
}

void Command::action(std::function<int()> work) {
    app_->callback([work = std::move(work), shared = shared_] { shared->chosen = work; });
}

void Command::footer(const char* text) { app_->footer(text); }

void Command::rest_after(const char* mark, Words& values) {
    shared_->rest_of = app_->get_name();
    shared_->rest_mark = mark;
    shared_->rest = &values;
}

void Command::left_out(const std::string& why) {
    app_->allow_extras();
    action([why]() -> int { throw ConfigError(why); });
}

Program::Program(const char* name, const char* what)
    : app_(std::make_unique<CLI::App>(what, name)) {
    app_->set_version_flag("--version", DYNAMIC_FILTER_VERSION);
    app_->failure_message(usage_error);
}

Program::~Program() = default;

Command Program::command(const char* name, const char* what) {
    app_->require_subcommand(1);
    return Command(*app_->add_subcommand(name, what), shared_);
}

Command Program::options() { return Command(*app_, shared_); }

int Program::run(std::span<char* const> all_arguments) {
    const std::vector<char*> arguments = without_rest(all_arguments, shared_);
    refuse_unknown_command(*app_, arguments);
    try {
        app_->parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError& error) {
        // An unknown option is what to say first; that another one is missing may follow from it.
        const bool is_help = error.get_exit_code() == 0;
        if (!is_help && !app_->remaining(true).empty()) refuse_unknown_options(*app_);
        return app_->exit(error) == 0 ? kDone : kUsage;
    }
    const int code = shared_.chosen();
    // A result that could not be printed (a full disk, say) is not a result.
    finish_saying();
    return code;
}

}  // namespace dynamic_filter::app
