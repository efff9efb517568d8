#include "json_strict.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_names.h"

namespace swept {
namespace {

// No format of ours nests deeper than 7; the bound keeps recursive readers off the end of the stack.
constexpr std::size_t kDeepest = 64;
constexpr int kNumberOverflow = 406;  // nlohmann's id of "number overflow"

std::string lineAndColumn(std::string_view text, std::size_t offset) {
    offset = std::min(offset, text.size());
    std::size_t line = 1;
    std::size_t column = 1;
    for (std::size_t i = 0; i < offset; ++i) {
        if (text[i] == '\n') {
            ++line;
            column = 1;
        } else if ((static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u) {  // not the inside of a UTF-8 sequence
            ++column;
        }
    }
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// The parser's message without its own prefix and position, and without bytes that may not be text.
std::string plainMessage(std::string message) {
    const std::size_t column = message.find("column ");
    const std::size_t start = column == std::string::npos ? std::string::npos : message.find(": ", column);
    if (start != std::string::npos) { message.erase(0, start + 2); }
    for (char& c : message) {
        if (static_cast<unsigned char>(c) >= 0x80 || static_cast<unsigned char>(c) < 0x20) { c = '?'; }
    }
    return message;
}

/// What people and programs write though no JSON has it.
struct CommonMistake {
    std::size_t offset;  ///< where it begins
    std::string reason;
};

constexpr std::string_view kBlanks = " \t\r\n";

/// Whether the parser's message begins like this, behind what was being parsed.
bool isAbout(std::string_view message, std::string_view what) {
    const std::size_t dash = message.find(" - ");
    return dash != std::string_view::npos && message.substr(dash + 3).starts_with(what);
}

/// The characters around `at` of which numbers and literals are made; none where it is another.
std::string_view wordAt(std::string_view text, std::size_t at) {
    const auto isOfWord = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '+' ||
               c == '.';
    };
    std::size_t begin = at;
    std::size_t end = at;
    while (end < text.size() && isOfWord(text[end])) { ++end; }
    while (end > at && begin > 0 && isOfWord(text[begin - 1])) { --begin; }
    return text.substr(begin, end - begin);
}

/// `1/60`, which programs take for a number.
std::optional<CommonMistake> fractionAt(std::string_view text, std::size_t slash) {
    const std::size_t over = slash == 0 ? std::string_view::npos : text.find_last_not_of(kBlanks, slash - 1);
    const std::size_t under = text.find_first_not_of(kBlanks, slash + 1);
    if (over == std::string_view::npos || under == std::string_view::npos) { return std::nullopt; }
    const std::string_view numberOver = wordAt(text, over);
    const std::string_view numberUnder = wordAt(text, under);
    const Json valueOver = Json::parse(numberOver, nullptr, false);
    const Json valueUnder = Json::parse(numberUnder, nullptr, false);
    if (!valueOver.is_number() || !valueUnder.is_number()) { return std::nullopt; }
    CommonMistake mistake{over + 1 - numberOver.size(), "JSON has no fractions"};
    const double value = valueOver.get<double>() / valueUnder.get<double>();
    const std::size_t next = text.find_first_not_of(kBlanks, under + numberUnder.size());
    const bool isAll = next == std::string_view::npos || text[next] == ',' || text[next] == ']' || text[next] == '}';
    if (isAll && std::isfinite(value)) { mistake.reason += ": " + shortestNumber(value); }
    return mistake;
}

/// What stands where no JSON value begins.
std::optional<CommonMistake> noLiteral(std::string_view text, std::size_t offset) {
    if (text[offset] == '\'') { return CommonMistake{offset, "strings have double quotes, not single ones"}; }
    if (text[offset] != '/') { return std::nullopt; }
    const char next = offset + 1 < text.size() ? text[offset + 1] : ' ';
    if (next == '/' || next == '*') { return CommonMistake{offset, "JSON has no comments"}; }
    return fractionAt(text, offset);
}

/// @param offset   of the last character that the parser read
/// @param message  of the parser
std::optional<CommonMistake> commonMistake(std::string_view text, std::size_t offset, std::string_view message) {
    // Within a string all of these are text.
    if (offset >= text.size() || isAbout(message, "invalid string")) { return std::nullopt; }
    if (text[offset] == ']' || text[offset] == '}') {
        const std::size_t before = offset == 0 ? std::string_view::npos : text.find_last_not_of(kBlanks, offset - 1);
        if (before == std::string_view::npos || text[before] != ',') { return std::nullopt; }
        return CommonMistake{before, std::string("a trailing comma: nothing follows it before ") + text[offset]};
    }
    if (isAbout(message, "invalid literal")) {
        if (auto mistake = noLiteral(text, offset)) { return mistake; }
    }
    const auto isOfWord = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-'; };
    std::size_t begin = offset;
    std::size_t end = offset;
    while (begin > 0 && isOfWord(text[begin - 1])) { --begin; }
    while (end < text.size() && isOfWord(text[end])) { ++end; }
    const std::string_view word = text.substr(begin, end - begin);
    constexpr std::string_view kNoNumbers[] = {"NaN",      "nan",       "-NaN", "-nan", "Infinity", "-Infinity",
                                               "infinity", "-infinity", "inf",  "-inf", "Inf",      "-Inf"};
    if (std::find(std::begin(kNoNumbers), std::end(kNoNumbers), word) == std::end(kNoNumbers)) { return std::nullopt; }
    return CommonMistake{begin, std::string(word) + " is no JSON number"};
}

/// The string whose closing quote this is.
std::string_view stringBefore(std::string_view text, std::size_t quote) {
    const auto isEscaped = [text](std::size_t at) {
        std::size_t first = at;
        while (first > 0 && text[first - 1] == '\\') { --first; }
        return (at - first) % 2 == 1;
    };
    std::size_t begin = quote;
    while (begin > 0) {
        --begin;
        if (text[begin] == '"' && !isEscaped(begin)) { break; }
    }
    return text.substr(begin, quote + 1 - begin);
}

/// Two members or elements with nothing between them.
/// @param offset   of the last character of the second, or the first of a container
/// @param message  of the parser
std::optional<CommonMistake> missingComma(std::string_view text, std::size_t offset, std::string_view message) {
    const bool inObject = message.ends_with("expected '}'");
    if (offset >= text.size() || !isAbout(message, "unexpected")) { return std::nullopt; }
    if (!inObject && !message.ends_with("expected ']'")) { return std::nullopt; }
    if (text[offset] == '{' || text[offset] == '[') {
        const std::string bracket(1, text[offset]);
        if (inObject) { return CommonMistake{offset, "a } is missing before " + bracket + ", or a comma and a key"}; }
        return CommonMistake{offset, "a comma is missing before " + bracket};
    }
    const bool isString = text[offset] == '"';
    const std::string_view token = isString ? stringBefore(text, offset) : wordAt(text, offset);
    // 1-2 and 01 are two numbers to the parser, but to nobody else; and what is no key has no place in an object.
    if ((inObject && !isString) || !Json::accept(token)) { return std::nullopt; }
    const auto begin = static_cast<std::size_t>(token.data() - text.data());
    return CommonMistake{begin, "a comma is missing before " + std::string(token)};
}

// Builds the value and keeps the path, so that errors can name their place.
class StrictBuilder {
public:
    explicit StrictBuilder(std::string_view text) : text_(text) {}

    JsonResult take() {
        return error_ ? JsonResult{Json(), std::move(error_)}
                      : JsonResult{std::move(root_), {}, std::move(underflows_)};
    }

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(Json::number_integer_t value) { return add(value); }
    bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
    bool number_float(Json::number_float_t value, const std::string& token) {
        add(value);
        const std::string digits = token.substr(0, token.find_first_of("eE"));
        if (value == 0 && digits.find_first_of("123456789") != std::string::npos) {
            underflows_.push_back({pointer(), token});
        }
        return true;
    }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(Json::binary_t&) { return false; }  // exists in binary formats only
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        Level& level = levels_.back();
        level.key = name;
        if (!level.seen.insert(name).second) { return fail(pointer(), "the key occurs twice in this object"); }
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) {
        if (error.id == kNumberOverflow) {
            countElement();
            return fail(pointer(), "the number " + token + " overflows");
        }
        const std::size_t offset = position > 0 ? position - 1 : 0;  // of the last character that was read
        const std::string message = plainMessage(error.what());
        if (const auto mistake = commonMistake(text_, offset, message)) {
            return fail(lineAndColumn(text_, mistake->offset), mistake->reason);
        }
        if (const auto mistake = missingComma(text_, offset, message)) {
            return fail(lineAndColumn(text_, mistake->offset), mistake->reason);
        }
        return fail(lineAndColumn(text_, offset), message);
    }

private:
    struct Level {
        Json* value = nullptr;
        std::string key;             // the present one, in an object
        std::set<std::string> seen;  // all so far, in an object
        std::size_t count = 0;       // elements so far, in an array
    };

    bool fail(std::string where, std::string reason) {
        error_ = JsonError{std::move(where), std::move(reason)};
        return false;
    }

    void countElement() {
        if (!levels_.empty() && levels_.back().value->is_array()) { ++levels_.back().count; }
    }

    // Of the key or element that is being read.
    std::string pointer() const {
        std::string result;
        for (const Level& level : levels_) {
            result += '/';
            result += level.value->is_array() ? std::to_string(level.count - 1) : escapedToken(level.key);
        }
        return result;
    }

    template <class Value>
    Json* place(Value&& value) {
        countElement();
        if (levels_.empty()) {
            root_ = Json(std::forward<Value>(value));
            return &root_;
        }
        Level& level = levels_.back();
        if (level.value->is_array()) {
            level.value->push_back(Json(std::forward<Value>(value)));
            return &level.value->back();
        }
        // The key is new, so the search of the ordered map's own insertion is not needed.
        auto& members = static_cast<Json::object_t::Container&>(level.value->get_ref<Json::object_t&>());
        members.emplace_back(level.key, Json(std::forward<Value>(value)));
        return &members.back().second;
    }

    template <class Value>
    bool add(Value&& value) {
        place(std::forward<Value>(value));
        return true;
    }

    bool open(Json&& empty) {
        Json* const value = place(std::move(empty));
        if (levels_.size() == kDeepest) {
            return fail(pointer(), "nested deeper than " + std::to_string(kDeepest) + " levels");
        }
        levels_.emplace_back();
        levels_.back().value = value;
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    Json root_;
    std::vector<Level>
        levels_;  // the containers that are open; their addresses are stable, for only the last one grows
    std::optional<JsonError> error_;
    std::vector<JsonUnderflow> underflows_;
};

}  // namespace

JsonResult parseStrict(std::string_view text) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        return {Json(), JsonError{"line 1, column 1", "there is no JSON value"}};
    }
    // To the parser it would be the end of the text, wherever it stands.
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        return {Json(), JsonError{lineAndColumn(text, nul), "a NUL byte, which no JSON text has"}};
    }
    StrictBuilder builder(text);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

std::string escapedToken(std::string_view token) {
    std::string escaped;
    for (const char c : token) {
        if (c == '~') {
            escaped += "~0";
        } else if (c == '/') {
            escaped += "~1";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string Place::pointer() const {
    if (parent == nullptr) { return {}; }
    return parent->pointer() + '/' + (isIndex ? std::to_string(index) : escapedToken(key));
}

std::string kindOf(const Json& value) {
    if (value.is_null()) { return "null"; }
    if (value.is_boolean()) { return value.get<bool>() ? "true" : "false"; }
    if (value.is_number()) { return "a number"; }
    if (value.is_string()) { return "a string"; }
    return value.is_array() ? "an array" : "an object";
}

}  // namespace swept
