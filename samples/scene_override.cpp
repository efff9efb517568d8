#include <algorithm>
#include <charconv>
#include <vector>

#include "scene_json.h"
#include "scene_names.h"

namespace swept {
namespace {

enum class Step : std::uint8_t { ok, notAnIndex, pastTheEnd, notAContainer, notThere };

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

// Goes down one token. Missing members of objects are made, and objects to hold them; the element behind the last of an
// array only as the target, and arrays not at all: what else would be in them?
Step descend(Json*& at, const std::string& token, bool isLast) {
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
    index = at->size();
    if (token != "-" && !parseIndex(token, index)) { return Step::notAnIndex; }
    if (index > at->size() || (index == at->size() && !isLast)) { return Step::pastTheEnd; }
    if (index == at->size()) { at->push_back(nullptr); }
    at = &(*at)[index];
    return Step::ok;
}

std::string reasonFor(Step step, const Json& at, const std::string& token) {
    switch (step) {
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
    for (std::size_t start = 1; start <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', start), pointer.size());
        std::string token;
        if (!unescape(std::string_view(pointer).substr(start, end - start), token)) {
            return fail("not a JSON pointer: ~ must be followed by 0 or 1");
        }
        const Step step = descend(at, token, end == pointer.size());
        if (step != Step::ok) { return fail(reasonFor(step, *at, token)); }
        start = end + 1;
    }
    for (const JsonUnderflow& inside : parsed.underflows) {
        underflows.push_back({pointer + inside.where, inside.number});
    }
    *at = std::move(parsed.value);
    return std::nullopt;
}

}  // namespace swept
