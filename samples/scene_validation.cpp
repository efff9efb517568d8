#include <string>
#include <utility>

#include "field_check.h"
#include "joint_validation.h"
#include "scene_geometry.h"
#include "scene_names.h"
#include "scene_reader.h"

namespace swept {
namespace {

/// Walks a scene in the order of the format and keeps the first error.
class Validator : private FieldCheck {
public:
    Validator(const SceneDescription& scene, double largest) : FieldCheck(largest), scene_(scene) {}

    std::optional<SceneError> run() {
        if (!checkScene()) { return takeError(); }
        return std::nullopt;
    }

private:
    bool checkShape(const ShapeDescription& shape, SceneBodyType type, const Place& place) {
        const std::string_view kind = geometryNames()[shape.geometry.index()];
        const Place geometry = place.at(kind);
        const bool goodNumbers = std::visit([&](const auto& g) { return checkFields(g, geometry); }, shape.geometry);
        if (!goodNumbers) { return false; }
        if (const auto fault = geometryFault(shape.geometry)) {
            return fail({"", geometry.pointer() + fault->member, fault->reason});
        }
        if (kind == "chain" && type == SceneBodyType::dynamic) {
            return fail(geometry, "a chain needs a static or kinematic body, this one is dynamic");
        }
        if ((kind == "circle" || kind == "capsule") && shape.radius != 0) {
            return fail(place.at("radius"), "the radius of a " + std::string(kind) + " belongs inside \"" +
                                                std::string(kind) + "\", not beside it");
        }
        return checkFields(shape, place);
    }

    bool checkMotion(const BodyDescription& body, const Place& place) {
        const bool turns = body.angularVelocity != 0;
        if (body.type == SceneBodyType::fixed) {
            if (!(body.velocity == DVec2{})) {
                return fail(place.at("velocity"),
                            "a static body does not move, but has velocity " + textOf(body.velocity));
            }
            if (turns) {
                return fail(place.at("angularVelocity"), "a static body does not turn, but has angular velocity " +
                                                             shortestNumber(body.angularVelocity));
            }
        }
        if (body.fixedRotation && turns) {
            return fail(place.at("angularVelocity"),
                        "a body with fixed rotation does not turn, but has angular velocity " +
                            shortestNumber(body.angularVelocity));
        }
        if (body.type == SceneBodyType::dynamic) { return true; }
        const std::string type(namesOf<SceneBodyType>()[static_cast<std::size_t>(body.type)]);
        if (body.mass) { return fail(place.at("mass"), "only a dynamic body has a mass, this one is " + type); }
        if (body.inertia) {
            return fail(place.at("inertia"), "only a dynamic body has an inertia, this one is " + type);
        }
        return true;
    }

    bool checkMass(const BodyDescription& body, const Place& place) {
        if (body.type != SceneBodyType::dynamic) { return true; }
        const MassAndInertia shapes = massOfShapes(body);
        const double mass = body.mass.value_or(shapes.mass);
        // A given mass scales the inertia that the shapes have.
        const double perMass = body.mass && shapes.mass > 0 ? *body.mass / shapes.mass : 1;
        const double inertia = body.inertia.value_or(shapes.inertia * perMass);
        const double least = 1 / largest();
        const auto missing = [&](double value) { return !(value >= least); };
        const auto tooSmall = [&](double value, const std::string& unit) {
            return ", and " + shortestNumber(value) + unit + " is below the smallest allowed, " +
                   shortestNumber(least) + unit + ": give it larger shapes, more density, ";
        };
        if (missing(mass) && mass > 0) {
            return fail(place, "a dynamic body needs mass" + tooSmall(mass, " kg") + "or a \"mass\"");
        }
        if (missing(mass)) {
            return fail(place, "a dynamic body needs mass (its shapes give " + shortestNumber(shapes.mass) +
                                   " kg): give a shape area and density, or the body a \"mass\"");
        }
        if (missing(inertia) && inertia > 0 && !body.fixedRotation) {
            return fail(place, "a dynamic body that may turn needs inertia" + tooSmall(inertia, " kg·m²") +
                                   "an \"inertia\", or fixedRotation");
        }
        if (missing(inertia) && !body.fixedRotation) {
            return fail(place, "a dynamic body that may turn needs inertia (its shapes give " +
                                   shortestNumber(shapes.inertia) +
                                   " kg·m²): give a shape area and density, the body an \"inertia\", or fixedRotation");
        }
        if (mass > largest() || inertia > largest()) {
            return fail(place, "the mass or inertia of the shapes is too large: " + shortestNumber(mass) + " kg, " +
                                   shortestNumber(inertia) + " kg·m²; the largest number allowed is " +
                                   shortestNumber(largest()));
        }
        return true;
    }

    bool checkBody(const BodyDescription& body, const Place& place) {
        if (!checkFields(body, place) || !checkMotion(body, place)) { return false; }
        const Place shapes = place.at("shapes");
        for (std::size_t i = 0; i < body.shapes.size(); ++i) {
            if (!checkShape(body.shapes[i], body.type, shapes.at(i))) { return false; }
        }
        return checkMass(body, place);
    }

    bool checkScene() {
        const Place root;
        if (!checkFields(scene_, root)) { return false; }
        NameIndex names;
        const Place bodies = root.at("bodies");
        if (!checkNames(scene_.bodies, "body", bodies, names)) { return false; }
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (!checkBody(scene_.bodies[i], bodies.at(i))) { return false; }
        }
        std::optional<SceneError> fault = faultOfJoints(scene_, names, largest());
        return !fault || fail(std::move(*fault));
    }

    const SceneDescription& scene_;
};

}  // namespace

std::optional<SceneError> validateScene(const SceneDescription& scene, double largest) {
    return Validator(scene, largest).run();
}

}  // namespace swept
