#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace swept {

/// The rows of a file of `swept tune` without what a clock decides, in order.
inline std::vector<std::string> rowsWithoutCost(const std::string& text) {
    constexpr int kCostColumn = 10;
    std::vector<std::string> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::string row;
        int column = 0;
        for (std::string field; std::getline(fields, field, ','); ++column) {
            row += column == kCostColumn && line.find("reference") == std::string::npos ? "" : field + ',';
        }
        rows.push_back(row);
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

}  // namespace swept
