#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <swept/samples/scene_names.h>

#include "commands.h"

namespace swept {
namespace {

/// CLI11 explains some mistakes over several lines; ours take one.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The library would read 010 as 8, and take the largest there is for what is larger still.
template <class Integer>
std::string faultOfWholeNumber(const std::string& text) {
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    Integer number = 0;
    const auto [last, status] = std::from_chars(begin, end, number);
    if (status == std::errc::result_out_of_range && last == end) { return text + " is too large"; }
    const bool isOctal = end - begin > 1 && *begin == '0';
    if (status == std::errc() && last == end && !isOctal) { return ""; }
    return "must be a whole number, written in digits, not " + text;
}

/// As the library reads it.
std::string faultOfNumber(const std::string& text) {
    char* end = nullptr;
    (void)std::strtold(text.c_str(), &end);
    if (!text.empty() && end == text.c_str() + text.size()) { return ""; }
    return (text.empty() ? "\"\"" : text) + " is not a number";
}

std::string faultOfText(const std::string& text) { return text.empty() ? "must not be empty" : ""; }

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) { text += (text.empty() ? "" : ", ") + name; }
    return text;
}

/// A list that is longer than this is no help among the other options.
constexpr std::size_t kLongestList = 80;

/// `; did you mean "run"?`, or nothing.
std::string nearestOf(const std::string& word, const std::vector<std::string>& names) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string_view nearest = nearestName(word, known);
    return nearest.empty() ? "" : "; did you mean " + std::string(nearest) + '?';
}

/// One of what a list has. The list may take long to make: that is done when it is asked for.
class MemberOfList : public CLI::Validator {
public:
    using List = std::function<std::vector<std::string>()>;

    explicit MemberOfList(const List& list) {
        desc_function_ = [list] {
            const std::vector<std::string> names = list();
            const std::string all = joined(names);
            return all.size() <= kLongestList
                       ? '{' + all + '}'
                       : '{' + std::to_string(names.size()) + " names: any other word lists them}";
        };
        func_ = [list](std::string& value) {
            const std::vector<std::string> names = list();
            const bool isNamed = std::find(names.begin(), names.end(), value) != names.end();
            return isNamed ? "" : mustBeOneOf(names, value);
        };
    }
};

/// @param hasMost  whether the upper bound is one, and not just the end of what numbers can be
std::string outOfRange(const std::string& text, const std::string& least, const std::string& most, bool hasMost) {
    return "must be " + (hasMost ? "between " + least + " and " + most : "at least " + least) + ", not " + text;
}

/// Of the help.
std::string rangeText(const std::string& least, const std::string& most, bool hasMost) {
    return hasMost ? least + " to " + most : "at least " + least;
}

template <class T>
struct ValueOf {
    using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
    using Type = T;
};

/// Those that the help lists.
std::vector<std::string> namesOfCommands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!command->get_group().empty()) { names.push_back(command->get_name()); }
    }
    return names;
}

/// The command that was named.
const CLI::App& namedCommand(const CLI::App& program) {
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty()) { app = app->get_subcommands().front(); }
    return *app;
}

/// "--steps" and so on, of the command that was named.
std::vector<std::string> namesOfOptions(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : namedCommand(program).get_options()) {
        for (const std::string& name : option->get_lnames()) { names.push_back("--" + name); }
    }
    return names;
}

/// "help run" is "run --help".
std::vector<std::string> withHelpAsOption(std::vector<std::string> arguments) {
    if (arguments.empty() || arguments.front() != "help") { return arguments; }
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

/// "bench foo: no such command …" of the first word that should be a command and is none, or that there is no word
/// where one should be; empty: neither.
std::string faultOfCommand(const CLI::App& program, const std::vector<std::string>& arguments) {
    const CLI::App* app = &program;
    std::string path;
    const auto listedBy = [&program](const std::string& above) {
        return " (\"" + program.get_name() + above + " --help\" lists them)";
    };
    for (const std::string& word : arguments) {
        if (app->get_require_subcommand_min() == 0 || word.starts_with('-')) { return ""; }
        const auto isNamed = [&](const CLI::App* command) { return command->get_name() == word; };
        const auto found = app->get_subcommands(isNamed);
        const std::string above = path;
        path += ' ' + word;
        if (found.empty()) {
            const std::string nearest = nearestOf(word, namesOfCommands(*app));
            return path.substr(1) + ": no such command" + (nearest.empty() ? listedBy(above) : nearest);
        }
        app = found.front();
    }
    return app->get_require_subcommand_min() == 0 ? "" : "no command given" + listedBy(path);
}

/// "; did you mean --json WORD?" of a word beside the only option that takes any; or nothing.
std::string optionForWord(const CLI::App& program, const std::string& word) {
    const auto takesWords = [](const CLI::Option* option) { return option->get_items_expected_max() > 0; };
    const auto options = namedCommand(program).get_options(takesWords);
    const bool isOnlyOne = options.size() == 1 && options[0]->nonpositional() && options[0]->count() == 0;
    return isOnlyOne ? "; did you mean " + options[0]->get_name() + ' ' + word + '?' : "";
}

/// The first argument that nothing took; the library lists them all, from the back. Empty: there is none.
std::string faultOfLeftOver(const CLI::App& program, const std::vector<std::string>& arguments) {
    const std::vector<std::string> leftOver = program.remaining(true);
    const auto isLeftOver = [&](const std::string& argument) {
        return argument != "--" && std::find(leftOver.begin(), leftOver.end(), argument) != leftOver.end();
    };
    const auto first = std::find_if(arguments.begin(), arguments.end(), isLeftOver);
    if (first == arguments.end()) { return ""; }
    const bool isOption = first->size() > 1 && first->starts_with('-');
    if (isOption) {
        const std::string name = first->substr(0, first->find('='));
        return name + ": no such option" + nearestOf(name, namesOfOptions(program));
    }
    const std::string option = optionForWord(program, *first);
    return *first + ": one argument too many" +
           (program.get_subcommands().empty() || !option.empty() ? option : " (--help tells which there are)");
}

/// What was written to a pipe that nobody reads, or to a disk that is full, is lost: a success must not be claimed.
int withOutputWritten(int exitCode) {
    std::cout.flush();
    return std::cout ? exitCode : refuse("standard output cannot be written");
}

}  // namespace

std::string mustBeOneOf(const std::vector<std::string>& names, const std::string& value) {
    const std::string nearest = nearestOf(value, names);
    const std::string all = joined(names);
    const bool isShort = nearest.empty() || all.size() <= kLongestList;
    return "must be one of " + (isShort ? all : std::to_string(names.size()) + " names") + ", not " + value + nearest;
}

Option Option::type(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

Option Option::within(std::int64_t least, std::int64_t most) const {
    const bool hasMost = most < std::numeric_limits<int>::max();
    const auto fault = [=](const std::string& text) {
        // The library takes the largest there is for what is larger still, which unsigned values can be.
        std::string wrong = faultOfWholeNumber<std::int64_t>(text);
        if (!wrong.empty()) { return wrong; }
        const std::int64_t number = std::strtoll(text.c_str(), nullptr, 10);
        return number < least || number > most ? outOfRange(text, std::to_string(least), std::to_string(most), hasMost)
                                               : wrong;
    };
    option_->check(fault, rangeText(std::to_string(least), std::to_string(most), hasMost));
    return *this;
}

Option Option::withinReals(double least, double most) const {
    const auto fault = [=](const std::string& text) {
        const double number = std::strtod(text.c_str(), nullptr);
        // "nan" is a number, and neither below nor above anything.
        if (std::isnan(number)) { return text + " is not a number"; }
        return number < least || number > most ? outOfRange(text, shortestNumber(least), shortestNumber(most), true)
                                               : std::string();
    };
    option_->check(fault, rangeText(shortestNumber(least), shortestNumber(most), true));
    return *this;
}

Option Option::oneOf(const std::vector<std::string>& values) const {
    return oneOf([values] { return values; });
}

Option Option::oneOf(const std::function<std::vector<std::string>()>& list) const {
    option_->check(MemberOfList(list));
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
    CLI::Option* const option = app_->add_option(name, value, help);
    // In front of all other checks, which see a number where there may be none. No name: nothing in the help.
    using Value = typename ValueOf<T>::Type;
    if constexpr (std::is_integral_v<Value>) { option->check(faultOfWholeNumber<Value>, ""); }
    if constexpr (std::is_floating_point_v<Value>) { option->check(faultOfNumber, ""); }
    if constexpr (std::is_same_v<T, std::string>) { option->check(faultOfText, ""); }
    return Option(option);
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
               const std::vector<std::string>& typed) {
    const std::vector<std::string> arguments = withHelpAsOption(typed);
    CLI::App app(texts.description, texts.name);
    app.set_version_flag("--version", texts.version);
    app.footer(texts.footer);
    int exitCode = kExitDone;
    const Command program(&app, &exitCode);
    program.needsCommand();
    addCommands(program);
    if (const std::string fault = faultOfCommand(app, arguments); !fault.empty()) { return refuse(fault); }
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them from the back
    } catch (const CLI::Success& helpOrVersion) {
        return withOutputWritten(app.exit(helpOrVersion));
    } catch (const CLI::ParseError& mistake) {
        const int kind = mistake.get_exit_code();
        const bool isOfAll = kind == static_cast<int>(CLI::ExitCodes::ExtrasError) ||
                             kind == static_cast<int>(CLI::ExitCodes::RequiredError);
        const std::string leftOver = isOfAll ? faultOfLeftOver(app, arguments) : "";
        return refuse(leftOver.empty() ? firstLine(mistake.what()) : leftOver);
    }
    return withOutputWritten(exitCode);
}

}  // namespace swept
