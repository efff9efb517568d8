#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace swept {

/// A JSON value whose objects keep the order of the text.
using Json = nlohmann::ordered_json;

/// Why a text is not acceptable JSON.
struct JsonError {
    std::string where;  ///< JSON pointer of the culprit; syntax errors: "line 3, column 7" (both from 1, in characters)
    std::string reason;
};

/// A number that is too small for a double, and became 0.
struct JsonUnderflow {
    std::string where;   ///< JSON pointer
    std::string number;  ///< as it was written
};

/// A value or an error, never both.
struct JsonResult {
    Json value;
    std::optional<JsonError> error;
    std::vector<JsonUnderflow> underflows{};  ///< for those who take no 0
};

/// Parses by RFC 8259, and refuses what a lenient reader would let through: duplicate keys, numbers that overflow a
/// double, invalid UTF-8, NUL bytes, anything behind the value, and values nested deeper than 64 levels. Never throws.
JsonResult parseStrict(std::string_view text);

/// A place in a document, as a chain of nodes on the stack: costs nothing until an error asks for its text.
struct Place {
    const Place* parent = nullptr;
    std::string_view key;  ///< used when `isIndex` is false
    std::size_t index = 0;
    bool isIndex = false;

    Place at(std::string_view childKey) const { return {this, childKey, 0, false}; }
    Place at(std::size_t childIndex) const { return {this, {}, childIndex, true}; }
    /// RFC 6901; empty for the whole document.
    std::string pointer() const;
};

/// One reference token of a JSON pointer: `~` and `/` escaped.
std::string escapedToken(std::string_view token);

/// "a string", "a number", "an array", …: for messages.
std::string kindOf(const Json& value);

}  // namespace swept
