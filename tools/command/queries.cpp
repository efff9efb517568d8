#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "../toi/query_lines.h"
#include "../toi/toi_families.h"
#include "anatomy_output.h"
#include "commands.h"

namespace swept {
namespace {

struct QueryArguments {
    std::string file;
    std::string anatomy;
    std::string method = "certified";
    std::string precision = "f64";  ///< or "f32"
};

struct GenerateArguments {
    std::string family;
    int count = 100;
    std::uint64_t seed = 1;
};

using Answerer = std::function<LineAnswer(std::string_view)>;

/// Opens the file, or takes standard input, and hands it on.
int withLines(const std::string& path, const std::function<int(std::istream&)>& read) {
    std::ios::sync_with_stdio(false);
    if (path.empty() || path == "-") { return read(std::cin); }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) { return refuse(path + ": is a directory"); }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) { return refuse(path + ": cannot be read: " + std::generic_category().message(errno)); }
    return read(file);
}

int answerAll(const std::string& path, const Answerer& answer) {
    return withLines(path, [&answer](std::istream& lines) { return answerQueries(lines, std::cout, answer); });
}

/// Answers the first query alone, and draws how the answer was found.
int drawFirst(const QueryArguments& arguments) {
    return withLines(arguments.file, [&arguments](std::istream& lines) {
        const std::string source = arguments.file.empty() || arguments.file == "-" ? "standard input" : arguments.file;
        std::string line;
        int number = 0;
        for (; line.find_first_not_of(" \t\r") == std::string::npos; ++number) {
            if (!std::getline(lines, line)) { return refuse("--anatomy: " + source + ": there is no query"); }
        }
        ToiQuery query;
        if (const auto fault = readToiLine(line, query)) {
            return refuse(source + ": " + namingTheLine(*fault, number));
        }
        AnatomyPicture picture;
        std::string error;
        if (!picture.open(arguments.anatomy, arguments.file, error)) { return refuse(error); }
        // Whatever becomes of the picture.
        std::cout << answerToiLine(line).text << '\n';
        return picture.draw(query, error) ? kExitDone : refuse(error);
    });
}

std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const ToiMethodInfo& info : kToiMethods) { names.emplace_back(info.name); }
    return names;
}

/// One line a method.
std::string methodHelp() {
    std::string help = "How [certified]:";
    for (const ToiMethodInfo& info : kToiMethods) {
        help += "\n" + std::string(info.name) + ": " + std::string(info.description);
    }
    return help;
}

int answerToi(const QueryArguments& arguments) {
    const std::optional<ToiMethod> method = toiMethodFrom(arguments.method);
    if (!method) { return refuse("--method: " + mustBeOneOf(methodNames(), arguments.method)); }
    if (!arguments.anatomy.empty()) { return drawFirst(arguments); }
    return answerAll(arguments.file, [method](std::string_view line) { return answerToiLine(line, *method); });
}

int answerDistance(const QueryArguments& arguments) {
    const Precision precision = arguments.precision == "f32" ? Precision::f32 : Precision::f64;
    return answerAll(arguments.file,
                     [precision](std::string_view line) { return answerDistanceLine(line, precision); });
}

std::vector<std::string> familyNames() {
    std::vector<std::string> names;
    for (const ToiFamily family : kToiFamilies) { names.emplace_back(nameOf(family)); }
    return names;
}

int generateToi(const GenerateArguments& arguments) {
    const std::optional<ToiFamily> family = toiFamilyFrom(arguments.family);
    if (!family) { return refuse("--generate: " + mustBeOneOf(familyNames(), arguments.family)); }
    const std::string start = arguments.family + '-' + std::to_string(arguments.seed) + '-';
    for (int index = 0; index < arguments.count && std::cout; ++index) {
        const ToiQuery query = makeToiCase(*family, arguments.seed, static_cast<std::uint64_t>(index));
        std::cout << queryLine(query, start + std::to_string(index), arguments.family) << '\n';
    }
    return kExitDone;
}

/// Options that print queries instead of answering them. @return the one that asks for it
Option addGenerateOptions(Command toi, GenerateArguments& arguments) {
    std::string families;
    for (const std::string& name : familyNames()) { families += (families.empty() ? "" : ", ") + name; }
    const Option generate =
        toi.option("--generate", arguments.family, "Print queries of a family: " + families).type("FAMILY");
    toi.option("--count", arguments.count, "How many [100]")
        .type("N")
        .within(1, std::numeric_limits<int>::max())
        .needs(generate);
    toi.option("--seed", arguments.seed, "The same seed gives the same queries [1]")
        .type("S")
        .within(std::int64_t{0}, std::numeric_limits<std::int64_t>::max())
        .needs(generate);
    return generate;
}

Option addFileOption(Command command, QueryArguments& arguments) {
    return command.option("file", arguments.file, "Queries, one JSON object a line; standard input if left out")
        .type("FILE");
}

}  // namespace

void addQueryCommands(Command app) {
    const Command toi = app.command("toi", "Answer time-of-impact queries, one JSON line each");
    const auto toiArguments = std::make_shared<QueryArguments>();
    const Option file = addFileOption(toi, *toiArguments);
    const Option method = toi.option("--method", toiArguments->method, methodHelp()).type("NAME");
    const Option anatomy = toi.option("--anatomy", toiArguments->anatomy,
                                      "Answer the first query only, and draw how the default method finds the answer")
                               .type("FILE.png")
                               .excludes(method);
    const auto generateArguments = std::make_shared<GenerateArguments>();
    const Option generate = addGenerateOptions(toi, *generateArguments);
    for (const Option& answering : {file, method, anatomy}) { generate.excludes(answering); }
    toi.runs([toiArguments, generateArguments, generate] {
        return generate.isGiven() ? generateToi(*generateArguments) : answerToi(*toiArguments);
    });

    const Command distance = app.command("distance", "Answer distance queries (poses at fraction 0)");
    const auto distanceArguments = std::make_shared<QueryArguments>();
    addFileOption(distance, *distanceArguments);
    distance.option("--precision", distanceArguments->precision, "Build of the distance function [f64]")
        .type("P")
        .oneOf({"f32", "f64"});
    distance.runs([distanceArguments] { return answerDistance(*distanceArguments); });
}

}  // namespace swept
