#include "text_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace swept::bench {

void TextTable::write(std::ostream& out) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) { widths[i] = std::max(widths[i], row[i].size()); }
    }
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - row[i].size(), ' ');
            line += i == 0 ? row[i] + space : "  " + space + row[i];
        }
        out << line << '\n';
    }
}

std::string threeDigits(double value) {
    char text[32];
    const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value))));
    std::snprintf(text, sizeof text, "%.*f", std::clamp(2 - magnitude, 0, 6), value);
    return text;
}

}  // namespace swept::bench
