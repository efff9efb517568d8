#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace swept {

/// Of a record without quoted fields.
inline std::vector<std::string> fieldsOf(const std::string& record) {
    std::vector<std::string> fields;
    std::istringstream in(record);
    for (std::string field; std::getline(in, field, ',');) { fields.push_back(field); }
    return fields;
}

/// Records of a CSV file without quoted fields.
inline std::vector<std::vector<std::string>> recordsOf(const std::string& csv) {
    std::vector<std::vector<std::string>> records;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) { records.push_back(fieldsOf(line)); }
    return records;
}

/// Of a record, by the name of its column.
inline double numberIn(const std::vector<std::vector<std::string>>& records, std::size_t record, const char* column) {
    const auto found = std::find(records[0].begin(), records[0].end(), column);
    return std::stod(records[record].at(static_cast<std::size_t>(found - records[0].begin())));
}

}  // namespace swept
