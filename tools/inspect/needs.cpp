#include <algorithm>
#include <cmath>
#include <limits>

#include "../writers/number_text.h"
#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

/// The first body for which `holds`, in the order of the scene.
template <class Condition>
const PlacedBody* firstBody(const PlacedScene& placed, const Condition& holds) {
    const auto found = std::find_if(placed.bodies.begin(), placed.bodies.end(), holds);
    return found == placed.bodies.end() ? nullptr : &*found;
}

template <class Condition>
const PlacedBody* bodyWithShape(const PlacedScene& placed, const Condition& holds) {
    return firstBody(placed, [&](const PlacedBody& body) {
        return std::any_of(body.description->shapes.begin(), body.description->shapes.end(), holds);
    });
}

bool hasObstacles(const PlacedScene& placed) {
    return placed.pieces.size() > 1 &&
           bodyWithShape(placed, [](const ShapeDescription& shape) { return !shape.sensor; });
}

Need continuousNeed(const PlacedScene& placed) {
    const double dt = placed.scene->settings.dt;
    const PlacedBody* worst = nullptr;
    double worstRatio = 0;
    for (const PlacedBody& body : placed.bodies) {
        if (body.extent > 0 && body.description->type != SceneBodyType::fixed) {
            const double ratio = (body.isDynamic() ? reachableSpeed(placed, body) : body.speed) * dt / body.extent;
            if (ratio > worstRatio) {
                worstRatio = ratio;
                worst = &body;
            }
        }
    }
    const bool needed = hasObstacles(placed) && worstRatio > envelope::kFastRatio;
    if (worst == nullptr) { return {"continuous collision", false, "nothing moves by itself"}; }
    const std::string way = worstRatio < 1     ? roundedText(worstRatio, 2) + " of its width"
                            : worstRatio < 1e6 ? roundedText(worstRatio, 2) + " times its width"
                                               : "more than a million times its width";
    return {"continuous collision", needed,
            worst->name + " may move " + way + " in a step, by its start, motors and the fall alone (swept from " +
                roundedText(envelope::kFastRatio) + " on)"};
}

Need bulletNeed(const PlacedScene& placed) {
    const PlacedBody* const bullet = firstBody(placed, [&](const PlacedBody& body) { return isBullet(placed, body); });
    if (bullet != nullptr) { return {"bullets", true, bullet->name + " is one"}; }
    const PlacedBody* const idle =
        firstBody(placed, [](const PlacedBody& body) { return body.isDynamic() && body.description->bullet; });
    return {"bullets", false, idle != nullptr ? "those marked have other modes than subStep" : "no body is marked"};
}

Need restitutionNeed(const PlacedScene& placed) {
    const PlacedBody* const body = bodyWithShape(
        placed, [](const ShapeDescription& shape) { return !shape.sensor && anySurface(shape, bounces); });
    return {"restitution", body != nullptr, body != nullptr ? body->name + " bounces" : "no shape bounces"};
}

Need frictionNeed(const PlacedScene& placed) {
    // By default pairs mix √(μ₁μ₂): one shape without friction makes none.
    const RubbingBodies pair = firstRubbing(placed);
    if (pair.a < 0) { return {"friction", false, "no two shapes that may touch have any"}; }
    const auto nameOf = [&placed](int i) { return placed.bodies[static_cast<std::size_t>(i)].name; };
    return {"friction", true, nameOf(pair.a) + " may rub on " + nameOf(pair.b)};
}

Need beltNeed(const PlacedScene& placed) {
    const PlacedBody* const body =
        bodyWithShape(placed, [](const ShapeDescription& shape) { return !shape.sensor && anySurface(shape, isBelt); });
    return {"surface speed", body != nullptr, body != nullptr ? body->name + " is a belt" : "no shape is a belt"};
}

Need mixingNeed(const PlacedScene& placed) {
    const PlacedBody* const body =
        bodyWithShape(placed, [](const ShapeDescription& shape) { return !shape.sensor && hasMixingRule(shape); });
    return {"mixing rules", body != nullptr, body != nullptr ? body->name + " has its own" : "no shape has its own"};
}

Need rollingNeed(const PlacedScene& placed) {
    const PlacedBody* const body = bodyWithShape(
        placed, [](const ShapeDescription& shape) { return !shape.sensor && anySurface(shape, resistsRolling); });
    return {"rolling resistance", body != nullptr,
            body != nullptr ? body->name + " resists rolling" : "nothing resists rolling"};
}

Need rotationNeed(const PlacedScene& placed) {
    const PlacedBody* const body =
        firstBody(placed, [](const PlacedBody& b) { return b.isDynamic() && !b.description->fixedRotation; });
    if (body != nullptr) { return {"rotation", true, body->name + " may turn"}; }
    const bool isMoving = firstBody(placed, [](const PlacedBody& b) { return b.isDynamic(); }) != nullptr;
    return {"rotation", false, isMoving ? "all rotations are fixed" : "no body is dynamic"};
}

Need jointNeed(const PlacedScene& placed) {
    const std::size_t count = placed.scene->joints.size();
    return {"joints", count > 0, count > 0 ? std::to_string(count) + " of them" : "there are none"};
}

Need sensorNeed(const PlacedScene& placed) {
    const PlacedBody* const body = bodyWithShape(placed, [](const ShapeDescription& shape) { return shape.sensor; });
    return {"sensors", body != nullptr, body != nullptr ? body->name + " senses" : "there are none"};
}

Need sleepNeed(const PlacedScene& placed) {
    const auto count = std::count_if(placed.bodies.begin(), placed.bodies.end(),
                                     [](const PlacedBody& body) { return body.isDynamic(); });
    const bool canRest = length(placed.scene->gravity) > 0 && hasObstacles(placed);
    const bool pays = canRest && count > 1;
    return {
        "sleep", pays,
        pays ? std::to_string(count) + " dynamic bodies may come to rest"
             : (canRest ? "one body costs nothing worth sparing" : "without gravity or ground little comes to rest")};
}

Need precisionNeed(const PlacedScene& placed) {
    // What single precision holds relative to a body: its contacts' partners, and its own outline.
    double worst = 0;
    std::string where = "all shapes are small beside their tolerance in single precision";
    double thinnest = std::numeric_limits<double>::infinity();
    for (const PlacedBody& body : placed.bodies) {
        if (body.isDynamic() && body.extent > 0) { thinnest = std::min(thinnest, body.extent); }
    }
    for (const PlacedPiece& piece : placed.pieces) {
        const double reach = radiusAbout(piece.polygon, Vec2{0, 0});
        const double rounding = reach * static_cast<double>(std::numeric_limits<float>::epsilon());
        const double ratio = rounding / (envelope::kToleranceRatio * thinnest);
        if (ratio > std::max(worst, 1.0)) {
            worst = ratio;
            where = placed.bodies[static_cast<std::size_t>(piece.body)].name + " reaches " + roundedText(reach, 3) +
                    " m, the thinnest mover is " + roundedText(thinnest, 3) + " m";
        }
    }
    return {"f64", worst > 1, where};
}

}  // namespace

std::vector<Need> needsOf(const PlacedScene& placed) {
    return {continuousNeed(placed), bulletNeed(placed),  restitutionNeed(placed), frictionNeed(placed),
            beltNeed(placed),       rollingNeed(placed), mixingNeed(placed),      rotationNeed(placed),
            jointNeed(placed),      sensorNeed(placed),  sleepNeed(placed),       precisionNeed(placed)};
}

}  // namespace swept
