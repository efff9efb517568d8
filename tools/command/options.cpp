#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "commands.h"

namespace swept {
namespace {

/// CLI11 explains some mistakes over several lines; ours take one.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

Option Option::type(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

Option Option::within(std::int64_t least, std::int64_t most) const {
    option_->check(CLI::Range(least, most));
    return *this;
}

Option Option::withinReals(double least, double most) const {
    option_->check(CLI::Range(least, most));
    return *this;
}

Option Option::oneOf(const std::vector<std::string>& values) const {
    option_->check(CLI::IsMember(values));
    return *this;
}

Option Option::required() const {
    option_->required();
    return *this;
}

Option Option::separatedBy(char delimiter) const {
    option_->delimiter(delimiter);
    return *this;
}

Option Option::oneValueEach() const {
    option_->allow_extra_args(false);
    return *this;
}

Option Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

Option Option::needs(const Option& other) const {
    option_->needs(other.option_);
    return *this;
}

bool Option::isGiven() const { return option_->count() > 0; }

Command Command::command(const std::string& name, const std::string& help) const {
    CLI::App* const below = app_->add_subcommand(name, help);
    if (help.empty()) { below->group(""); }
    return {below, exitCode_};
}

void Command::needsCommand() const { app_->require_subcommand(1); }

template <class T>
Option Command::option(const std::string& name, T& value, const std::string& help) const {
    return Option(app_->add_option(name, value, help));
}

template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, std::int64_t&, const std::string&) const;
template Option Command::option(const std::string&, std::uint32_t&, const std::string&) const;
template Option Command::option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::int64_t>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;

Option Command::flag(const std::string& name, bool& value, const std::string& help) const {
    return Option(app_->add_flag(name, value, help));
}

void Command::runs(std::function<int()> action) const {
    app_->callback([action = std::move(action), exitCode = exitCode_] { *exitCode = action(); });
}

int runProgram(const ProgramTexts& texts, const std::function<void(Command)>& addCommands,
               std::vector<std::string> arguments) {
    CLI::App app(texts.description, texts.name);
    app.set_version_flag("--version", texts.version);
    app.footer(texts.footer);
    int exitCode = kExitDone;
    const Command program(&app, &exitCode);
    program.needsCommand();
    addCommands(program);
    if (arguments.empty()) { return refuse("no command given (\"" + texts.name + " --help\" lists them)"); }
    const auto isFirst = [&](const CLI::App* command) { return command->get_name() == arguments[0]; };
    if (!arguments[0].starts_with('-') && std::as_const(app).get_subcommands(isFirst).empty()) {
        return refuse(arguments[0] + ": no such command (\"" + texts.name + " --help\" lists them)");
    }
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    try {
        app.parse(arguments);
    } catch (const CLI::Success& helpOrVersion) {
        return app.exit(helpOrVersion);
    } catch (const CLI::ParseError& mistake) { return refuse(firstLine(mistake.what())); }
    return exitCode;
}

}  // namespace swept
