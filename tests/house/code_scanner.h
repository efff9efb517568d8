#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swept::house {

/// Whether a name or a number may have it in it.
bool isWordChar(char c);

/// The same text, line for line, with everything that is not code made blank: comments, the contents of string and
/// character literals, and preprocessor lines.
std::string codeOnly(std::string_view text);

struct FunctionSpan {
    std::string head;  ///< what stands before the body, in one line
    int firstLine = 0;
    int lastLine = 0;

    int lines() const { return lastLine - firstLine + 1; }
};

/// The function bodies of a file: every block outside of other functions that is headed by something with parentheses
/// and is no namespace, class, struct, union or enumeration. Lambdas count as part of the function around them.
std::vector<FunctionSpan> functionsIn(std::string_view text);

struct Include {
    std::string target;
    bool quoted = false;
    int line = 0;
};

/// The include lines of a file, those in comments left out.
std::vector<Include> includesIn(std::string_view text);

int lineCount(std::string_view text);

}  // namespace swept::house
