#include <array>
#include <cstdint>

#include "scene_fields.h"
#include "scene_json.h"
#include "scene_names.h"

namespace swept {
namespace {

// One `toJson` per kind of member; all declared first, since they call each other.
template <Described Object>
Json toJson(const Object& object);
template <class Element>
Json toJson(const std::vector<Element>& elements);
template <class Value>
Json toJson(const std::optional<Value>& value);
Json toJson(const ShapeDescription& shape);
Json toJson(const BodyDescription& body);
Json toJson(const JointDescription& joint);

Json toJson(double value) { return value; }
Json toJson(bool value) { return value; }
Json toJson(std::int32_t value) { return value; }
Json toJson(std::uint32_t value) { return value; }
Json toJson(const std::string& value) { return value; }
Json toJson(DVec2 value) { return Json::array({value.x, value.y}); }
Json toJson(const std::array<DVec2, 2>& points) { return Json::array({toJson(points[0]), toJson(points[1])}); }

template <class Enumeration>
requires std::is_enum_v<Enumeration> Json toJson(Enumeration value) {
    return std::string(namesOf<Enumeration>()[static_cast<std::size_t>(value)]);
}

template <class Value>
Json toJson(const std::optional<Value>& value) {
    return value ? toJson(*value) : Json();
}

template <class Element>
Json toJson(const std::vector<Element>& elements) {
    Json array = Json::array();
    for (const Element& element : elements) { array.push_back(toJson(element)); }
    return array;
}

// Adds the members that are required or differ from those of a new object.
template <Described Object>
void addFields(const Object& object, Json& json) {
    const Object defaults{};
    forEachField<Object>([&](const auto& field) {
        if (field.required || !(object.*(field.member) == defaults.*(field.member))) {
            json[field.key] = toJson(object.*(field.member));
        }
    });
}

template <Described Object>
Json toJson(const Object& object) {
    if constexpr (kBare<Object>) {
        return toJson(object.*(std::get<0>(kFields<Object>).member));
    } else {
        Json json = Json::object();
        addFields(object, json);
        return json;
    }
}

Json toJson(const ShapeDescription& shape) {
    Json json = Json::object();
    json[std::string(geometryNames()[shape.geometry.index()])] =
        std::visit([](const auto& geometry) { return toJson(geometry); }, shape.geometry);
    addFields(shape, json);
    return json;
}

Json toJson(const BodyDescription& body) {
    Json json = Json::object();
    if (!body.name.empty()) { json["name"] = body.name; }
    json["type"] = toJson(body.type);
    addFields(body, json);
    return json;
}

Json toJson(const JointDescription& joint) {
    Json json = Json::object();
    if (!joint.name.empty()) { json["name"] = joint.name; }
    json["type"] = std::string(jointTypeNames()[joint.joint.index()]);
    addFields(joint, json);
    std::visit([&](const auto& members) { addFields(members, json); }, joint.joint);
    return json;
}

}  // namespace

Json sceneToJson(const SceneDescription& scene) { return toJson(scene); }

std::string writeScene(const SceneDescription& scene) { return formatJson(sceneToJson(scene)); }

}  // namespace swept
