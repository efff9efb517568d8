#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "scene_fields.h"
#include "scene_json.h"
#include "scene_names.h"

namespace swept {
namespace {

template <class Value>
constexpr bool kWhole = false;
template <>
constexpr bool kWhole<std::int32_t> = true;
template <>
constexpr bool kWhole<std::uint32_t> = true;
template <>
constexpr bool kWhole<std::optional<std::int32_t>> = true;

/// Reads by the table of fields. Every `read` returns whether it succeeded; the first failure is kept in `error_`.
class JsonReader {
public:
    std::optional<SceneError> takeError() { return std::move(error_); }

    template <Described Object>
    bool read(const Json& value, const Place& place, Object& object) {
        if constexpr (kBare<Object>) {
            return read(value, place, object.*(std::get<0>(kFields<Object>).member));
        } else {
            return readObject(value, place, object);
        }
    }

    bool read(const Json& value, const Place& place, double& number) {
        if (!value.is_number()) { return wrongType(value, place, "a number"); }
        number = value.get<double>();
        return true;
    }

    bool read(const Json& value, const Place& place, bool& truth) {
        if (!value.is_boolean()) { return wrongType(value, place, "true or false"); }
        truth = value.get<bool>();
        return true;
    }

    bool read(const Json& value, const Place& place, std::string& text) {
        if (!value.is_string()) { return wrongType(value, place, "a string"); }
        text = value.get<std::string>();
        return true;
    }

    bool read(const Json& value, const Place& place, DVec2& vector) {
        if (!value.is_array()) { return wrongType(value, place, "two numbers [x, y]"); }
        if (value.size() != 2) { return fail(place, "must be two numbers [x, y], has " + elementCount(value)); }
        return read(value[0], place.at(0), vector.x) && read(value[1], place.at(1), vector.y);
    }

    bool read(const Json& value, const Place& place, std::array<DVec2, 2>& points) {
        if (!value.is_array()) { return wrongType(value, place, "two points [[x, y], [x, y]]"); }
        if (value.size() != 2) {
            return fail(place, "must be two points [[x, y], [x, y]], has " + elementCount(value));
        }
        return read(value[0], place.at(0), points[0]) && read(value[1], place.at(1), points[1]);
    }

    template <class Enumeration>
    requires std::is_enum_v<Enumeration>
    bool read(const Json& value, const Place& place, Enumeration& enumerator) {
        const auto names = namesOf<Enumeration>();
        if (!value.is_string()) { return wrongType(value, place, listOf(names)); }
        const std::string& word = value.get_ref<const std::string&>();
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == word) {
                enumerator = static_cast<Enumeration>(i);
                return true;
            }
        }
        return fail(place, "must be " + listOf(names) + ", not " + inQuotes(word));
    }

    template <class Value>
    bool read(const Json& value, const Place& place, std::optional<Value>& member) {
        return read(value, place, member.emplace());
    }

    template <class Element>
    bool read(const Json& value, const Place& place, std::vector<Element>& elements) {
        if (!value.is_array()) { return wrongType(value, place, "an array"); }
        elements.clear();
        elements.reserve(value.size());
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (!read(value[i], place.at(i), elements.emplace_back())) { return false; }
        }
        return true;
    }

    // One key more than the table: the one that names the geometry.
    bool read(const Json& value, const Place& place, ShapeDescription& shape) {
        if (!isObject(value, place)) { return false; }
        std::string_view geometry;
        const auto names = geometryNames();
        for (const auto& [key, member] : value.items()) {
            const Place here = place.at(key);
            std::size_t kind = 0;
            while (kind < names.size() && names[kind] != key) { ++kind; }
            if (kind == names.size()) {
                if (!readMember(key, member, here, shape)) { return handled(here, key, allShapeKeys(), ownerOf(key)); }
                continue;
            }
            if (!geometry.empty()) {
                return fail(here,
                            "a shape has exactly one geometry; this one is a " + std::string(geometry) + " already");
            }
            geometry = names[kind];
            if (!readAlternative(kind, member, here, shape.geometry)) { return false; }
        }
        if (geometry.empty()) { return fail(place, "a shape needs a geometry: " + listOf(names)); }
        const bool ownRadius = geometry == "circle" || geometry == "capsule";
        if (ownRadius && value.contains("radius")) {
            return fail(place.at("radius"), "the radius of a " + std::string(geometry) + " belongs inside \"" +
                                                std::string(geometry) + "\", not beside it");
        }
        return true;
    }

    // The type decides which other keys exist, so it is read first, wherever it stands.
    bool read(const Json& value, const Place& place, JointDescription& joint) {
        if (!isObject(value, place)) { return false; }
        if (!value.contains("type")) { return fail(place.at("type"), "is missing: " + listOf(jointTypeNames())); }
        std::size_t type = 0;
        if (!readJointType(value["type"], place.at("type"), type)) { return false; }
        joint.joint = makeAlternative(type);
        return std::visit([&](auto& geometry) { return readJointMembers(value, place, joint, geometry); }, joint.joint);
    }

private:
    static std::string elementCount(const Json& array) {
        return std::to_string(array.size()) + (array.size() == 1 ? " element" : " elements");
    }

    bool fail(const Place& place, std::string reason) {
        if (!error_) { error_ = SceneError{"", place.pointer(), std::move(reason)}; }
        return false;
    }

    bool wrongType(const Json& value, const Place& place, const std::string& expected) {
        return fail(place, "must be " + expected + ", not " + kindOf(value));
    }

    bool isObject(const Json& value, const Place& place) {
        return value.is_object() || wrongType(value, place, "an object {…}");
    }

    // False: `error_` says why, or else the key was unknown, and then this becomes the error.
    bool handled(const Place& place, std::string_view key, const std::vector<std::string_view>& known,
                 const std::string& owner = {}) {
        return fail(place, "unknown key " + inQuotes(key) +
                               (owner.empty() ? suggestion(key, known) : "; it belongs to " + owner));
    }

    template <class Object>
    static bool isKeyOf(std::string_view key) {
        std::vector<std::string_view> keys;
        appendKeys<Object>(keys);
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    }

    // Where else a scene has such a key; empty: nowhere.
    static std::string ownerOf(std::string_view key) {
        const std::vector<std::string_view> ofShapes = allShapeKeys();
        if (std::find(ofShapes.begin(), ofShapes.end(), key) != ofShapes.end()) { return "shapes"; }
        if (isKeyOf<BodyDescription>(key)) { return "bodies"; }
        if (isKeyOf<SettingsDescription>(key)) { return "\"settings\""; }
        return isKeyOf<SceneDescription>(key) ? "the scene itself" : "";
    }

    template <class Object>
    static void appendKeys(std::vector<std::string_view>& keys) {
        forEachField<Object>([&](const auto& field) { keys.push_back(field.key); });
    }

    static std::vector<std::string_view> allShapeKeys() {
        const auto names = geometryNames();
        std::vector<std::string_view> keys(names.begin(), names.end());
        appendKeys<ShapeDescription>(keys);
        return keys;
    }

    // Reads one member by its key. False without an error: the key is unknown.
    template <class Object>
    bool readMember(std::string_view key, const Json& value, const Place& place, Object& object) {
        bool done = false;
        forEachField<Object>([&](const auto& field) {
            if (done || error_ || key != field.key) { return; }
            auto& target = object.*(field.member);
            if constexpr (kWhole<std::remove_cvref_t<decltype(target)>>) {
                done = readWhole(value, place, field.range, target);
            } else {
                done = read(value, place, target);
            }
        });
        return done;
    }

    template <class Object>
    bool hasRequired(const Json& value, const Place& place) {
        bool complete = true;
        forEachField<Object>([&](const auto& field) {
            if (complete && field.required && !value.contains(field.key)) {
                complete = fail(place.at(std::string_view(field.key)), "is missing");
            }
        });
        return complete;
    }

    template <class Object>
    bool readObject(const Json& value, const Place& place, Object& object) {
        if (!isObject(value, place)) { return false; }
        for (const auto& [key, member] : value.items()) {
            const Place here = place.at(key);
            if (!readMember(key, member, here, object)) {
                std::vector<std::string_view> known;
                appendKeys<Object>(known);
                constexpr bool isOfScene = std::is_same_v<Object, SceneDescription> ||
                                           std::is_same_v<Object, BodyDescription> ||
                                           std::is_same_v<Object, SettingsDescription>;
                return handled(here, key, known, isOfScene ? ownerOf(key) : "");
            }
        }
        return hasRequired<Object>(value, place);
    }

    // What its type can hold; the error tells what of that its range allows, which the validation looks at.
    template <class Integer>
    bool readWhole(const Json& value, const Place& place, const Range& range, Integer& number) {
        using Limits = std::numeric_limits<Integer>;
        if (!value.is_number()) { return wrongType(value, place, "a whole number"); }
        const double wide = value.get<double>();  // exact for everything in range
        if (std::trunc(wide) != wide) { return fail(place, "must be a whole number, not " + shortestNumber(wide)); }
        constexpr auto kLeast = static_cast<double>(Limits::min());
        constexpr auto kMost = static_cast<double>(Limits::max());
        if (wide < kLeast || wide > kMost) {
            return fail(place, "must be a whole number from " + shortestNumber(std::max(kLeast, range.lowest)) +
                                   " to " + shortestNumber(std::min(kMost, range.highest)) + ", not " +
                                   shortestNumber(wide));
        }
        number = static_cast<Integer>(wide);
        return true;
    }
    template <class Integer>
    bool readWhole(const Json& value, const Place& place, const Range& range, std::optional<Integer>& number) {
        return readWhole(value, place, range, number.emplace());
    }

    template <std::size_t Index = 0>
    bool readAlternative(std::size_t kind, const Json& value, const Place& place, Geometry& geometry) {
        if constexpr (Index < std::variant_size_v<Geometry>) {
            if (kind == Index) { return read(value, place, geometry.template emplace<Index>()); }
            return readAlternative<Index + 1>(kind, value, place, geometry);
        } else {
            return fail(place, "unknown geometry");
        }
    }

    template <std::size_t Index = 0>
    static JointGeometry makeAlternative(std::size_t type) {
        if constexpr (Index + 1 < std::variant_size_v<JointGeometry>) {
            return type == Index ? JointGeometry(std::in_place_index<Index>) : makeAlternative<Index + 1>(type);
        } else {
            return JointGeometry(std::in_place_index<Index>);
        }
    }

    bool readJointType(const Json& value, const Place& place, std::size_t& type) {
        const auto names = jointTypeNames();
        if (!value.is_string()) { return wrongType(value, place, listOf(names)); }
        const std::string& word = value.get_ref<const std::string&>();
        for (type = 0; type < names.size(); ++type) {
            if (names[type] == word) { return true; }
        }
        return fail(place, "unknown joint type " + inQuotes(word) + suggestion(word, names));
    }

    template <class JointMembers>
    bool readJointMembers(const Json& value, const Place& place, JointDescription& joint, JointMembers& members) {
        for (const auto& [key, member] : value.items()) {
            const Place here = place.at(key);
            if (key == "type" || readMember(key, member, here, joint)) { continue; }
            if (!error_ && readMember(key, member, here, members)) { continue; }
            std::vector<std::string_view> known{"type"};
            appendKeys<JointDescription>(known);
            appendKeys<JointMembers>(known);
            return handled(here, key, known);
        }
        return hasRequired<JointDescription>(value, place) && hasRequired<JointMembers>(value, place);
    }

    std::optional<SceneError> error_;
};

// A name that is given must be one: the empty one means "unnamed" in a `SceneDescription`, and would vanish silently.
template <class Named>
std::optional<SceneError> emptyName(const Json& document, const char* list, const std::vector<Named>& elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i].name.empty() && document[list][i].contains("name")) {
            return SceneError{"", std::string("/") + list + "/" + std::to_string(i) + "/name",
                              "must not be empty; leave it out for an unnamed one"};
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<SceneError> sceneFromJson(const Json& value, SceneDescription& scene) {
    JsonReader reader;
    scene = SceneDescription{};
    if (!reader.read(value, Place{}, scene)) { return reader.takeError(); }
    if (auto error = emptyName(value, "bodies", scene.bodies)) { return error; }
    return emptyName(value, "joints", scene.joints);
}

}  // namespace swept
