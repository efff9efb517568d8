#include "callgrind_lines.h"

#include <cstdlib>
#include <sstream>

namespace swept {
namespace {

/// "(12) name" gives a number to a name, "(12)" says it again.
std::string nameOf(const std::string& text, std::map<std::string, std::string>& names) {
    const std::size_t end = text.find(')');
    if (text.empty() || text[0] != '(' || end == std::string::npos) { return text; }
    const std::string number = text.substr(0, end + 1);
    if (end + 2 < text.size()) { names[number] = text.substr(end + 2); }
    return names[number];
}

}  // namespace

LineCosts readCallgrind(const std::string& text) {
    LineCosts costs;
    std::map<std::string, std::string> files;
    std::string file;
    int line = 0;
    bool isCall = false;  // the next line of costs is that of a call, which counts elsewhere
    std::istringstream lines(text);
    for (std::string row; std::getline(lines, row);) {
        const std::size_t equals = row.find('=');
        const std::string key = row.substr(0, equals);
        if (key == "fl" || key == "fi" || key == "fe") {
            file = nameOf(row.substr(equals + 1), files);
        } else if (key == "cfi" || key == "cfl") {
            (void)nameOf(row.substr(equals + 1), files);
        } else if (key == "calls") {
            isCall = true;
        } else if (!row.empty() && (row[0] == '+' || row[0] == '-' || row[0] == '*' || std::isdigit(row[0]) != 0)) {
            char* rest = row.data();
            if (row[0] == '*') {
                ++rest;
            } else {
                const long number = std::strtol(row.data(), &rest, 10);
                line = static_cast<int>(row[0] == '+' || row[0] == '-' ? line + number : number);
            }
            if (!isCall) { costs[{file, line}] += std::strtoll(rest, nullptr, 10); }
            isCall = false;
        }
    }
    return costs;
}

}  // namespace swept
