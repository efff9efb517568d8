#include "row.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "../writers/number_text.h"

namespace swept::envelope {
namespace {

constexpr std::size_t kFields = 7;  // x, y, engine, value, bound, inside, verdict
constexpr const char* kColumns = "x,y,engine,value,bound,inside,verdict";

std::array<std::string, kFields> fieldsOf(const std::string& line) {
    std::array<std::string, kFields> fields;
    std::istringstream stream(line);
    for (std::string& field : fields) { std::getline(stream, field, ','); }
    return fields;
}

bool parseNumber(const std::string& text, double& number) {
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    return failure == std::errc{} && stop == end;
}

bool parseEngine(const std::string& text, tune::Engine& engine) {
    for (int i = 0; i < tune::kEngineCount; ++i) {
        if (text == tune::nameOf(static_cast<tune::Engine>(i))) {
            engine = static_cast<tune::Engine>(i);
            return true;
        }
    }
    return false;
}

bool parseRow(const std::string& line, Row& row) {
    const auto fields = fieldsOf(line);
    row.verdict = fields[6];
    return std::count(line.begin(), line.end(), ',') == kFields - 1 && parseNumber(fields[0], row.x) &&
           parseNumber(fields[1], row.y) && parseEngine(fields[2], row.engine) && parseNumber(fields[3], row.value);
}

}  // namespace

std::string csvHeader(const Slice& slice) {
    return "# " + slice.name + ": x is " + slice.x.label + ", y is " + slice.y.label + "; value: " + slice.measure +
           "\n" + kColumns + "\n";
}

std::string csvLine(const Slice& slice, const Row& row) {
    std::string line;
    appendNumber(line, row.x);
    line += ',';
    appendNumber(line, row.y);
    line += std::string(",") + tune::nameOf(row.engine) + ',';
    appendNumber(line, row.value);
    line += ',';
    appendNumber(line, slice.bound);
    std::string verdict = row.verdict;
    std::replace_if(
        verdict.begin(), verdict.end(), [](char c) { return c == ',' || c == '\n'; }, ';');
    return line + (row.isInside(slice) ? ",yes," : ",no,") + verdict + '\n';
}

const Row* Rows::find(double x, double y, tune::Engine engine) const {
    const auto found = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const Row& row) { return row.x == x && row.y == y && row.engine == engine; });
    return found == rows_.end() ? nullptr : &*found;
}

void Rows::add(const Row& row) {
    if (find(row.x, row.y, row.engine) == nullptr) { rows_.push_back(row); }
}

bool Rows::parse(const Slice& slice, const std::string& text, const std::string& file, std::string& error) {
    const std::string header = csvHeader(slice);
    if (header.starts_with(text)) {
        return true;  // interrupted before the first row
    }
    if (!text.starts_with(header)) {
        error = file + ": is not a file of the slice \"" + slice.name + "\" as it is now; take it away to begin anew";
        return false;
    }
    std::size_t begin = header.size();
    int number = 2;  // lines of the header
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        ++number;
        Row row;
        if (!parseRow(text.substr(begin, end - begin), row)) {
            error = file + ":" + std::to_string(number) + ": is not a row of " + kColumns;
            return false;
        }
        add(row);
    }
    return true;
}

std::optional<double> limitOf(const Slice& slice, const Rows& rows, double y, tune::Engine engine) {
    std::optional<double> limit;
    for (const double x : slice.x.values) {
        const Row* const row = rows.find(x, y, engine);
        if (row == nullptr || !row->isInside(slice)) { break; }
        limit = x;
    }
    return limit;
}

std::string lineOf(const Slice& slice, const Rows& rows, double y, tune::Engine engine) {
    std::string line;
    for (const double x : slice.x.values) {
        const Row* const row = rows.find(x, y, engine);
        line += row == nullptr ? '?' : (row->isInside(slice) ? '#' : '.');
    }
    return line;
}

}  // namespace swept::envelope
