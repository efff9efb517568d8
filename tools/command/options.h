#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace swept {

/// "must be one of f32, f64, not f16", for what is refused after the name of its option. Of a long list only how many
/// there are, when one of them is near.
std::string mustBeOneOf(const std::vector<std::string>& names, const std::string& value);

/// One option of a command. A handle: cheap to copy, valid as long as its program.
class Option {
public:
    explicit Option(CLI::Option* option) : option_(option) {}

    /// How the help calls its value: "FILE".
    Option type(const std::string& name) const;
    /// Refuses other values; both ends are allowed.
    Option within(std::int64_t least, std::int64_t most) const;
    Option withinReals(double least, double most) const;
    Option oneOf(const std::vector<std::string>& values) const;
    /// Likewise; they are listed only for a value that was given, and for the help.
    Option oneOf(const std::function<std::vector<std::string>()>& list) const;
    Option required() const;
    /// Several values in one argument, between such characters.
    Option separatedBy(char delimiter) const;
    /// Each use of a repeated option takes one value.
    Option oneValueEach() const;
    Option excludes(const Option& other) const;
    Option needs(const Option& other) const;

    [[nodiscard]] bool isGiven() const;

private:
    CLI::Option* option_;
};

/// A command of the program, or the program itself. A handle likewise.
///
/// All of the command-line library is behind this file: it is one large header of templates, and each file that reads
/// it takes three times as long to compile.
class Command {
public:
    Command(CLI::App* app, int* exitCode) : app_(app), exitCode_(exitCode) {}

    /// A command below this one. Without a help text it is not listed.
    [[nodiscard]] Command command(const std::string& name, const std::string& help) const;
    /// One of the commands below has to be named.
    void needsCommand() const;

    /// An option "--name", or a positional argument "name". A value that is not given is left as it is.
    /// T: std::string, int, std::int64_t, std::uint32_t, std::uint64_t, double, std::optional of double or
    /// std::int64_t, or std::vector of std::string.
    template <class T>
    Option option(const std::string& name, T& value, const std::string& help) const;
    Option flag(const std::string& name, bool& value, const std::string& help) const;

    /// What the command does; the result becomes the program's exit code.
    void runs(std::function<int()> action) const;

private:
    CLI::App* app_;
    int* exitCode_;
};

/// The texts of a program that has commands.
struct ProgramTexts {
    std::string name;
    std::string description;
    std::string version;
    std::string footer;  ///< below the help
};

/// Lets `addCommands` add the commands, then reads the arguments (without the program's own name) and runs what they
/// ask for.
/// @return exit code; mistakes are told on standard error, in one line, and give kExitBadInput (commands.h).
int runProgram(const ProgramTexts& texts, const std::function<void(Command)>& addCommands,
               const std::vector<std::string>& arguments);

}  // namespace swept
