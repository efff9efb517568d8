#pragma once

#include <string>
#include <string_view>

namespace swept {

/// A text of the user's (a name, a path) as a quoted string of a gnuplot script, with its quotes. In those gnuplot
/// looks for neither commands nor escapes; but a line break would end the string, and what follows it would be run: so
/// control characters become spaces.
std::string gnuplotQuoted(std::string_view text);

}  // namespace swept
