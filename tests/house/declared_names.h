#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace swept::house {

/// The words and marks of a text that `codeOnly` gave, in order; each mark is one character, but for `::` and `->`.
std::vector<std::string_view> tokensOf(std::string_view code);

bool isWord(std::string_view token);

/// What a file declares, as far as its text tells.
struct DeclaredNames {
    /// In a namespace: types, aliases, concepts, constants and variables.
    std::set<std::string, std::less<>> things;
    std::set<std::string, std::less<>> functions;  ///< in a namespace
    /// Anywhere: types, template parameters, and what stands behind a type as a name of something would.
    std::set<std::string, std::less<>> anywhere;
};

/// @param tokens  of the whole file
DeclaredNames declaredIn(const std::vector<std::string_view>& tokens);

}  // namespace swept::house
