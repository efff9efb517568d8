#include "scene_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "scene_reader.h"

namespace swept {
namespace {

constexpr std::array<std::string_view, 3> kBodyTypes{"static", "kinematic", "dynamic"};
constexpr std::array<std::string_view, 5> kContinuous{"off", "speedLimit", "speculative", "stop", "subStep"};
constexpr std::array<std::string_view, 2> kProfiles{"accurate", "fast"};
constexpr std::array<std::string_view, 7> kBroadphases{"automatic", "allPairs", "sortAndSweep", "quadtree",
                                                       "grid",      "bvh",      "wideBvh"};
constexpr std::array<std::string_view, 6> kMixingRules{"usual",   "geometricMean", "average",
                                                       "minimum", "product",       "maximum"};
constexpr std::array<std::string_view, 6> kGeometries{"box", "circle", "capsule", "segment", "polygon", "chain"};
constexpr std::array<std::string_view, 10> kJointTypes{"revolute", "distance", "prismatic", "wheel",  "weld",
                                                       "motor",    "mouse",    "gear",      "pulley", "filter"};
static_assert(kGeometries.size() == std::variant_size_v<Geometry>);
static_assert(kJointTypes.size() == std::variant_size_v<JointGeometry>);

// Longer words are cut before they are compared: a suggestion for them would be noise, and the cost is their product.
constexpr std::size_t kLongestWord = 40;
constexpr std::size_t kLongestQuote = 60;

char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
    for (std::size_t i = 0; i <= a.size(); ++i) { cost[i][0] = i; }
    for (std::size_t j = 0; j <= b.size(); ++j) { cost[0][j] = j; }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lowerCase(a[i - 1]) == lowerCase(b[j - 1]);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (same ? 0u : 1u)});
            const bool swapped = i > 1 && j > 1 && lowerCase(a[i - 1]) == lowerCase(b[j - 2]) &&
                                 lowerCase(a[i - 2]) == lowerCase(b[j - 1]);
            if (swapped) { cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1); }
        }
    }
    return cost[a.size()][b.size()];
}

}  // namespace

template <>
std::span<const std::string_view> namesOf<SceneBodyType>() {
    return kBodyTypes;
}
template <>
std::span<const std::string_view> namesOf<SceneContinuous>() {
    return kContinuous;
}
template <>
std::span<const std::string_view> namesOf<SceneProfile>() {
    return kProfiles;
}
template <>
std::span<const std::string_view> namesOf<SceneBroadphase>() {
    return kBroadphases;
}
template <>
std::span<const std::string_view> namesOf<MixingRule>() {
    return kMixingRules;
}

std::span<const std::string_view> geometryNames() { return kGeometries; }
std::span<const std::string_view> jointTypeNames() { return kJointTypes; }

std::string listOf(std::span<const std::string_view> names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) { list += i + 1 < names.size() ? ", " : " or "; }
        list += inQuotes(names[i]);
    }
    return list;
}

std::string_view nearestName(std::string_view word, std::span<const std::string_view> names) {
    if (word.empty() || word.size() > kLongestWord) { return {}; }
    std::string_view nearest;
    // Not every letter may be wrong: "z" was not meant to be "x".
    std::size_t best = std::min(std::max<std::size_t>(1, word.size() / 3) + 1, word.size());
    for (const std::string_view name : names) {
        const std::size_t distance = editDistance(word, name);
        if (distance < best) {
            best = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string shortSuggestion(std::string_view word, const std::vector<std::string>& names) {
    constexpr std::size_t kMostNames = 8;  // in one line
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (known.size() <= kMostNames || !nearestName(word, known).empty()) { return suggestion(word, known); }
    return suggestion(word, std::span(known).first(kMostNames)) + " and " + std::to_string(known.size() - kMostNames) +
           " more";
}

std::string suggestion(std::string_view word, std::span<const std::string_view> names) {
    const std::string_view nearest = nearestName(word, names);
    if (!nearest.empty()) { return "; did you mean " + inQuotes(nearest) + "?"; }
    std::string list;
    for (const std::string_view name : names) {
        list += list.empty() ? "" : ", ";
        list += name;
    }
    return list.empty() ? std::string() : "; known here: " + list;
}

std::string shortestNumber(double value) {
    if (std::isnan(value)) { return "nan"; }
    if (std::isinf(value)) { return value > 0 ? "inf" : "-inf"; }
    std::array<char, 32> text{};  // the longest shortest form, -2.2250738585072014e-308, has 24 characters
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000  // as Emscripten 3.1.6 has it: no doubles in to_chars
    int digits = 1;
    do {
        std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    } while (std::strtod(text.data(), nullptr) != value && ++digits <= 17);
    return text.data();
#else
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return std::string(text.data(), end.ptr);
#endif
}

std::string textOf(DVec2 vector) {
    std::string text = "[";
    text += shortestNumber(vector.x);
    text += ", ";
    text += shortestNumber(vector.y);
    return text + ']';
}

std::string inQuotes(std::string_view text) {
    std::string result = "\"";
    std::size_t end = std::min(text.size(), kLongestQuote);
    while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) {
        --end;
    }  // whole characters
    const std::string_view shown = text.substr(0, end);
    for (const char c : shown) {
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            constexpr std::string_view kHex = "0123456789abcdef";
            result += "\\u00";
            result += kHex[static_cast<unsigned char>(c) >> 4];
            result += kHex[static_cast<unsigned char>(c) & 15];
        } else {
            result += c;
        }
    }
    return result + (shown.size() < text.size() ? "…\"" : "\"");
}

std::string bodyName(const SceneDescription& scene, std::size_t index) {
    const std::string& name = scene.bodies[index].name;
    return name.empty() ? "body" + std::to_string(index) : name;
}

std::string jointName(const SceneDescription& scene, std::size_t index) {
    const std::string& name = scene.joints[index].name;
    return name.empty() ? "joint" + std::to_string(index) : name;
}

}  // namespace swept
