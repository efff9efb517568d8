#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace swept::bench {

/// Rows of cells, the first column to the left, the others to the right, each as wide as it must be.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> head) { rows_.push_back(std::move(head)); }
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    void write(std::ostream& out) const;

private:
    std::vector<std::vector<std::string>> rows_;
};

/// Three significant digits, without an exponent: 1234567, 1235, 12.3, 0.0123.
std::string threeDigits(double value);

}  // namespace swept::bench
