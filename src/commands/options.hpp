// SPDX-License-Identifier: MIT
/// Commands and their options: a thin front over CLI11. Only options.cpp includes CLI11, because
/// each file that does takes long to compile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/run.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dynamic_filter::app {

/// An option of a command, to say more of it.
class Option {
public:
    explicit Option(CLI::Option& option) : option_(&option) {}
    Option& required();
    Option& needs(const Option& other);
    Option& excludes(const Option& other);

private:
    CLI::Option* option_;
};

/// Smallest and largest number that an option takes; both are included.
struct Bounds {
    double low = 0.0;
    double high = 0.0;  ///< of whole numbers, 0: any
};

/// A command. Each option is written to its variable when it is given; the variable must live as
/// long as the command. Names are written as "-o,--output", or "DATA" for an argument without a
/// name.
class Command {
public:
    /// What a command sets in its program.
    struct Shared {
        std::function<int()> chosen;  ///< what to do
        std::string rest_of;          ///< the command with arguments of another kind
        std::string rest_mark;        ///< the word before them
        std::vector<std::string>* rest = nullptr;
    };

    Command(CLI::App& app, Shared& shared) : app_(&app), shared_(&shared) {}

    Option text(const char* names, std::string& value, const std::string& what);
    Option path(const char* names, std::filesystem::path& value, const std::string& what);
    Option path(const char* names, std::optional<std::filesystem::path>& value,
                const std::string& what);
    /// At most `most` paths; 0: any number.
    Option paths(const char* names, std::vector<std::filesystem::path>& values,
                 const std::string& what, int most = 0);
    /// One word each time that the option is given.
    Option words(const char* names, std::vector<std::string>& values, const std::string& what);
    Option choice(const char* names, std::string& value, const std::vector<std::string>& choices,
                  const std::string& what);
    /// The same, but the option may also stand without a word, which is then `alone`.
    Option choice_or(const char* names, std::string& value, const std::vector<std::string>& choices,
                     const std::string& alone, const std::string& what);
    /// Names that begin with "!" switch the flag off.
    Option flag(const char* names, bool& value, const std::string& what);
    Option number(const char* names, double& value, Bounds bounds, const std::string& what);
    /// A whole number of 0 or more; `Whole` is any type that holds one.
    template <class Whole>
    Option whole(const char* names, Whole& value, Bounds bounds, const std::string& what) {
        return whole(
            names, [&value](std::uint64_t given) { value = static_cast<Plain<Whole>>(given); },
            default_of(value), bounds, what);
    }

    /// What follows the word `mark` on the command line, up to the word "--", goes to `values` as
    /// it is. One command of a program may have this.
    void rest_after(const char* mark, std::vector<std::string>& values);

    void footer(const char* text);

    /// Does the command; returns the exit code.
    void action(std::function<int()> work);
    /// The program has not got the command: whatever its options are, ConfigError says why.
    void left_out(const std::string& why);

private:
    template <class T>
    struct Value {
        using Type = T;
    };
    template <class T>
    struct Value<std::optional<T>> {
        using Type = T;
    };
    template <class T>
    using Plain = typename Value<T>::Type;
    template <class T>
    static std::optional<std::uint64_t> default_of(const T& value) {
        if (value <= T{0}) return {};  // "any", or that of the scene; the text says it
        return static_cast<std::uint64_t>(value);
    }
    template <class T>
    static std::optional<std::uint64_t> default_of(const std::optional<T>&) {
        return {};
    }
    Option whole(const char* names, const std::function<void(std::uint64_t)>& set,
                 std::optional<std::uint64_t> standard, Bounds bounds, const std::string& what);

    CLI::App* app_;
    Shared* shared_;  // of the program
};

/// A program with commands, or with options alone.
class Program {
public:
    Program(const char* name, const char* what);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    Command command(const char* name, const char* what);
    /// The program itself, if it has no commands.
    Command options();

    /// Reads the arguments and does what they say. Returns the exit code. Throws ConfigError for an
    /// unknown command or option.
    int run(std::span<char* const> arguments);

private:
    std::unique_ptr<CLI::App> app_;
    Command::Shared shared_;
};

}  // namespace dynamic_filter::app
