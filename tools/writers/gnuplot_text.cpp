#include "gnuplot_text.h"

namespace swept {

std::string gnuplotQuoted(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\'') { quoted += '\''; }  // a quote within is doubled
        quoted += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return quoted + '\'';
}

}  // namespace swept
