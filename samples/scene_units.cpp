#include "scene_units.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "scene_names.h"
#include "scene_reader.h"

namespace swept {
namespace {

// --- scaling

class Scaler {
public:
    Scaler(int length, int mass, int time) : length_(length), mass_(mass), time_(time) {}

    template <Described Object>
    void apply(Object& object, const Dimension&) const {
        applyFields(object);
    }
    void apply(ShapeDescription& shape, const Dimension&) const {
        std::visit([&](auto& geometry) { applyFields(geometry); }, shape.geometry);
        applyFields(shape);
    }
    void apply(JointDescription& joint, const Dimension&) const {
        applyFields(joint);
        std::visit([&](auto& members) { applyFields(members); }, joint.joint);
    }
    void apply(double& value, const Dimension& d) const {
        value = std::ldexp(value, length_ * d.length + mass_ * d.mass + time_ * d.time);
    }
    void apply(DVec2& value, const Dimension& d) const {
        apply(value.x, d);
        apply(value.y, d);
    }
    void apply(std::array<DVec2, 2>& points, const Dimension& d) const {
        for (DVec2& point : points) { apply(point, d); }
    }
    template <class Element>
    void apply(std::vector<Element>& elements, const Dimension& d) const {
        for (Element& element : elements) { apply(element, d); }
    }
    template <class Value>
    void apply(std::optional<Value>& value, const Dimension& d) const {
        if (value) { apply(*value, d); }
    }
    template <class Value>
    requires(std::is_enum_v<Value> || std::is_integral_v<Value> ||
             std::is_same_v<Value, std::string>) void apply(Value&, const Dimension&) const {}  // no unit

private:
    template <Described Object>
    void applyFields(Object& object) const {
        forEachField<Object>([&](const auto& field) { apply(object.*(field.member), field.dimension); });
    }

    int length_;
    int mass_;
    int time_;
};

// --- the table as rows

/// Walks the types, not a scene.
class UnitLister {
public:
    std::vector<FieldUnit> rows;

    template <class Value>
    void list(const std::string& at, const Dimension& dimension) {
        if constexpr (Described<Value>) {
            listFields<Value>(at);
        } else {
            listValue(static_cast<const Value*>(nullptr), at, dimension);
        }
    }

private:
    template <class Object>
    void listFields(const std::string& at) {
        if constexpr (std::is_same_v<Object, ShapeDescription>) {
            listGeometries(at, static_cast<const Geometry*>(nullptr));
        }
        forEachField<Object>([&](const auto& field) {
            using Value = std::remove_cvref_t<decltype(std::declval<Object&>().*(field.member))>;
            list<Value>(kBare<Object> ? at : at + "/" + field.key, field.dimension);
        });
        if constexpr (std::is_same_v<Object, JointDescription>) {
            listAlternatives(at, static_cast<const JointGeometry*>(nullptr));
        }
    }

    template <class... Alternatives>
    void listGeometries(const std::string& at, const std::variant<Alternatives...>*) {
        std::size_t kind = 0;
        (listFields<Alternatives>(std::string(at).append("/").append(geometryNames()[kind++])), ...);
    }

    template <class... Alternatives>
    void listAlternatives(const std::string& at, const std::variant<Alternatives...>*) {
        std::size_t kind = 0;
        ((jointType_ = jointTypeNames()[kind++], listFields<Alternatives>(at)), ...);
    }

    void listValue(const double*, const std::string& at, const Dimension& d) {
        // Joint types share members: those of the same unit are one row, with their type where the unit is another.
        std::string field = at;
        for (const FieldUnit& row : rows) {
            if (row.field != at) { continue; }
            if (row.dimension == d) { return; }
            field = at + " (" + jointType_ + ")";
        }
        rows.push_back({field, d});
    }
    void listValue(const DVec2*, const std::string& at, const Dimension& d) { listValue(kScalar, at, d); }
    void listValue(const std::array<DVec2, 2>*, const std::string& at, const Dimension& d) {
        listValue(kScalar, at + "/*", d);
    }
    template <class Element>
    void listValue(const std::vector<Element>*, const std::string& at, const Dimension& d) {
        list<Element>(at + "/*", d);
    }
    template <class Value>
    void listValue(const std::optional<Value>*, const std::string& at, const Dimension& d) {
        list<Value>(at, d);
    }
    template <class Value>
    requires(std::is_enum_v<Value> || std::is_integral_v<Value> ||
             std::is_same_v<Value, std::string>) void listValue(const Value*, const std::string&, const Dimension&) {
    }  // no unit

    static constexpr const double* kScalar = nullptr;
    std::string jointType_;
};

void appendUnit(std::string& text, const char* unit, int power) {
    if (power <= 0) { return; }
    text += text.empty() ? "" : "·";
    text += unit;
    if (power == 2) { text += "²"; }
}

}  // namespace

std::vector<FieldUnit> sceneUnits() {
    UnitLister lister;
    lister.list<SceneDescription>("", Dimension{});
    return lister.rows;
}

std::string unitText(const Dimension& d) {
    std::string above;
    appendUnit(above, "kg", d.mass);
    appendUnit(above, "m", d.length);
    appendUnit(above, "s", d.time);
    std::string below;
    appendUnit(below, "kg", -d.mass);
    appendUnit(below, "m", -d.length);
    appendUnit(below, "s", -d.time);
    if (above.empty()) {
        above += '1';  // assigning "1" is an overflow in the eyes of GCC 12
    }
    return below.empty() ? above : above + "/" + below;
}

Dimension gearRatioUnit(const SceneDescription& scene, const GearDescription& gear) {
    const auto slides = [&scene](const std::string& name) {
        for (std::size_t i = 0; i < scene.joints.size(); ++i) {
            if (jointName(scene, i) == name) {
                return std::holds_alternative<PrismaticDescription>(scene.joints[i].joint) ? 1 : 0;
            }
        }
        return 0;
    };
    return {slides(gear.jointA) - slides(gear.jointB), 0, 0};
}

SceneDescription scaled(const SceneDescription& scene, int lengthPower, int massPower, int timePower) {
    SceneDescription result = scene;
    Scaler(lengthPower, massPower, timePower).apply(result, Dimension{});
    for (JointDescription& joint : result.joints) {
        if (auto* gear = std::get_if<GearDescription>(&joint.joint)) {
            gear->ratio = std::ldexp(gear->ratio, lengthPower * gearRatioUnit(result, *gear).length);
        }
    }
    return result;
}

}  // namespace swept
