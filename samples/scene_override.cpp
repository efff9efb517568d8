#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_json.h"
#include "scene_names.h"

namespace swept {
namespace {

enum class Step : std::uint8_t { ok, notAnIndex, notAName, severalOfThatName, pastTheEnd, notAContainer, notThere };

// RFC 6901: "0", or digits that do not start with 0.
bool parseIndex(const std::string& token, std::size_t& index) {
    if (token.empty() || (token.size() > 1 && token[0] == '0')) { return false; }
    const auto [end, status] = std::from_chars(token.data(), token.data() + token.size(), index);
    return status == std::errc() && end == token.data() + token.size();
}

// False: a `~` that is followed by neither 0 nor 1.
bool unescape(std::string_view escaped, std::string& token) {
    for (std::size_t i = 0; i < escaped.size(); ++i) {
        if (escaped[i] != '~') {
            token += escaped[i];
            continue;
        }
        ++i;
        if (i == escaped.size() || (escaped[i] != '0' && escaped[i] != '1')) { return false; }
        token += escaped[i] == '0' ? '~' : '/';
    }
    return true;
}

// Of the scene's bodies or joints, as `bodyName` and `jointName` say; empty: it is of another kind.
std::vector<std::string> namesIn(const Json& document, const Json& array) {
    constexpr std::pair<const char*, const char*> kNamed[] = {{"bodies", "body"}, {"joints", "joint"}};
    std::vector<std::string> names;
    for (const auto& [member, kind] : kNamed) {
        if (!document.contains(member) || &document[member] != &array) { continue; }
        for (const Json& element : array) {
            const bool hasName = element.is_object() && element.contains("name") && element["name"].is_string();
            names.push_back(hasName ? element["name"].get<std::string>() : kind + std::to_string(names.size()));
        }
    }
    return names;
}

// An element of an array: by index, or by name in the arrays whose elements have one.
Step findElement(const Json& document, const Json& array, const std::string& token, std::size_t& index) {
    index = array.size();
    if (token == "-" || parseIndex(token, index)) { return Step::ok; }
    const std::vector<std::string> names = namesIn(document, array);
    if (names.empty()) { return Step::notAnIndex; }
    const auto found = std::find(names.begin(), names.end(), token);
    if (found == names.end()) { return Step::notAName; }
    index = static_cast<std::size_t>(found - names.begin());
    return std::count(found, names.end(), token) == 1 ? Step::ok : Step::severalOfThatName;
}

// Goes down one token. Missing members of objects are made, and objects to hold them; the element behind the last of an
// array only as the target, and arrays not at all: what else would be in them? The token of an element becomes its
// index.
Step descend(const Json& document, Json*& at, std::string& token, bool isLast) {
    std::size_t index = 0;
    if (at->is_null()) {
        if (token == "-" || parseIndex(token, index)) { return Step::notThere; }
        *at = Json::object();
    }
    if (at->is_object()) {
        at = &(*at)[token];
        return Step::ok;
    }
    if (!at->is_array()) { return Step::notAContainer; }
    const Step found = findElement(document, *at, token, index);
    if (found != Step::ok) { return found; }
    if (index > at->size() || (index == at->size() && !isLast)) { return Step::pastTheEnd; }
    if (index == at->size()) { at->push_back(nullptr); }
    token = std::to_string(index);
    at = &(*at)[index];
    return Step::ok;
}

std::string reasonFor(Step step, const Json& document, const Json& at, const std::string& token) {
    switch (step) {
        case Step::notAName:
            return inQuotes(token) + " is neither an index nor the name of one of them" +
                   shortSuggestion(token, namesIn(document, at));
        case Step::severalOfThatName:
            return "there are several with the name " + inQuotes(token);
        case Step::notAnIndex:
            return inQuotes(token) + " is not the index of an array element";
        case Step::pastTheEnd:
            return "there is no element " + inQuotes(token) + ", the array has " + std::to_string(at.size());
        case Step::notAContainer:
            return "there is no " + inQuotes(token) + " inside " + kindOf(at);
        case Step::notThere:
            return "the scene leaves out the array that would have element " + inQuotes(token) +
                   ": set all of it, as in [0, 1]";
        case Step::ok:
            break;
    }
    return {};
}

}  // namespace

std::optional<SceneError> applyOverride(Json& document, const Override& change,
                                        std::vector<JsonUnderflow>& underflows) {
    const std::string& pointer = change.first;
    const std::string& text = change.second;
    const std::string given = "--set " + pointer + "=" + text + ": ";
    const auto fail = [&](const std::string& reason) { return SceneError{"", pointer, given + reason}; };
    if (pointer.empty() || pointer[0] != '/') {
        return SceneError{"", "", given + "not a JSON pointer: it must start with / (as in /settings/dt)"};
    }
    JsonResult parsed = parseStrict(text);
    if (parsed.error) {
        const bool looksLikeWord = !text.empty() && text.find_first_of("\"[]{} ") == std::string::npos &&
                                   (text[0] < '0' || text[0] > '9') && text[0] != '-';
        const bool isNoNumber = parsed.error->reason.ends_with(" is no JSON number");  // its place is all of the text
        if (isNoNumber) { return fail(parsed.error->reason); }
        if (looksLikeWord) { return fail("not a JSON value (a string needs double quotes: \"" + text + "\")"); }
        const std::string where = parsed.error->where.empty() ? "" : parsed.error->where + ": ";
        return fail("not a JSON value: " + where + parsed.error->reason);
    }
    Json* at = &document;
    std::string reached;  // the same pointer, as errors of a scene have it: by indices alone
    for (std::size_t start = 1; start <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', start), pointer.size());
        std::string token;
        if (!unescape(std::string_view(pointer).substr(start, end - start), token)) {
            return fail("not a JSON pointer: ~ must be followed by 0 or 1");
        }
        const Step step = descend(document, at, token, end == pointer.size());
        if (step != Step::ok) { return fail(reasonFor(step, document, *at, token)); }
        reached += '/' + escapedToken(token);
        start = end + 1;
    }
    for (const JsonUnderflow& inside : parsed.underflows) {
        underflows.push_back({reached + inside.where, inside.number});
    }
    *at = std::move(parsed.value);
    return std::nullopt;
}

}  // namespace swept
