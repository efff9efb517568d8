#include "declared_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <span>

#include "code_scanner.h"

namespace swept::house {
namespace {

using Tokens = std::span<const std::string_view>;

bool isOneOf(std::string_view token, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), token) != words.end();
}

bool beginsType(std::string_view token) {
    return isOneOf(token, {"struct", "class", "union", "enum", "concept", "using", "typename"});
}

/// The place behind the bracket that closes the one at `at`.
std::size_t behindBrackets(Tokens tokens, std::size_t at, std::string_view open, std::string_view close) {
    int depth = 0;
    for (; at < tokens.size(); ++at) {
        if (tokens[at] == open) { ++depth; }
        if (tokens[at] == close && --depth == 0) { return at + 1; }
    }
    return at;
}

/// The place of a type's name, from its keyword on.
std::size_t nameOfType(Tokens tokens, std::size_t keyword) {
    std::size_t at = keyword + 1;
    if (at < tokens.size() && isOneOf(tokens[at], {"class", "struct"})) { ++at; }
    if (at < tokens.size() && tokens[at] == "[") { at = behindBrackets(tokens, at, "[", "]"); }
    if (at < tokens.size() && tokens[at] == "alignas") { at = behindBrackets(tokens, at + 1, "(", ")"); }
    return at;
}

/// Notes what a declaration in a namespace declares.
/// @param statement  without its block or semicolon
void note(Tokens statement, DeclaredNames& names) {
    if (!statement.empty() && statement[0] == "template") {
        statement = statement.subspan(behindBrackets(statement, 1, "<", ">"));
    }
    if (statement.size() < 2) { return; }
    if (beginsType(statement[0])) {
        const std::size_t at = nameOfType(statement, 0);
        if (at < statement.size() && isWord(statement[at])) { names.things.emplace(statement[at]); }
        return;
    }
    const auto end = std::find_if(statement.begin(), statement.end(), [](std::string_view token) {
        return isOneOf(token, {"(", "=", "["});
    });
    const auto count = end - statement.begin();
    if (count < 2 || !isWord(end[-1]) || end[-1] == "operator" || isOneOf(end[-2], {"::", "operator"})) { return; }
    const bool isFunction = end != statement.end() && *end == "(";
    (isFunction ? names.functions : names.things).emplace(end[-1]);
}

/// Notes what stands in namespaces: every statement that is in no other block.
void noteNamespaces(Tokens tokens, DeclaredNames& names) {
    std::size_t depth = 0;  // of blocks that are no namespaces
    std::size_t first = 0;  // of the statement
    for (std::size_t at = 0; at < tokens.size(); ++at) {
        const Tokens statement = tokens.subspan(first, at - first);
        if (tokens[at] == "{") {
            const bool isNamespace = depth == 0 && !statement.empty() &&
                                     (isOneOf(statement[0], {"namespace", "extern"}) ||
                                      (statement.size() > 1 && statement[1] == "namespace"));
            if (isNamespace) {
                first = at + 1;
                continue;
            }
            if (depth == 0) { note(statement, names); }
            ++depth;
        } else if (tokens[at] == "}") {
            if (depth > 0) { --depth; }
            if (depth == 0) { first = at + 1; }
        } else if (tokens[at] == ";" && depth == 0) {
            note(statement, names);
            first = at + 1;
        }
    }
}

/// Whether the token at `at` ends a type, with something behind it that may be its name.
bool endsType(Tokens tokens, std::size_t at) {
    // `A& b`, but not `a & b`.
    while (at > 0 && isOneOf(tokens[at], {"&", "*"}) &&
           tokens[at - 1].data() + tokens[at - 1].size() == tokens[at].data()) {
        --at;
    }
    return isOneOf(tokens[at], {">", "]"}) ||
           (isWord(tokens[at]) && !isOneOf(tokens[at], {"return", "else", "case", "throw", "new", "delete", "do"}));
}

}  // namespace

bool isWord(std::string_view token) {
    return isWordChar(token[0]) && std::isdigit(static_cast<unsigned char>(token[0])) == 0;
}

std::vector<std::string_view> tokensOf(std::string_view code) {
    std::vector<std::string_view> tokens;
    for (std::size_t at = 0; at < code.size();) {
        std::size_t end = at + 1;
        if (std::isspace(static_cast<unsigned char>(code[at])) != 0) {
            at = end;
            continue;
        }
        if (isWordChar(code[at])) {
            while (end < code.size() && isWordChar(code[end])) { ++end; }
        } else if (code.substr(at).starts_with("::") || code.substr(at).starts_with("->")) {
            ++end;
        }
        tokens.push_back(code.substr(at, end - at));
        at = end;
    }
    return tokens;
}

DeclaredNames declaredIn(const std::vector<std::string_view>& tokens) {
    DeclaredNames names;
    noteNamespaces(tokens, names);
    names.anywhere = names.things;
    for (std::size_t at = 0; at < tokens.size(); ++at) {
        if (beginsType(tokens[at])) {
            const std::size_t name = nameOfType(tokens, at);
            if (name < tokens.size() && isWord(tokens[name])) { names.anywhere.emplace(tokens[name]); }
        }
        const bool mayBeName = at > 0 && isWord(tokens[at]) && at + 1 < tokens.size() &&
                               isOneOf(tokens[at + 1], {"(", "{", "=", ";", "["});
        if (mayBeName && endsType(tokens, at - 1)) { names.anywhere.emplace(tokens[at]); }
    }
    return names;
}

}  // namespace swept::house
