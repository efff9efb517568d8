#include "peer_limits.h"

#include <swept/samples/scene_surfaces.h>

#include <variant>

#include "box2d_approximations.h"

namespace swept {
namespace {

/// Corners that a polygon of Box2D 3 may have.
constexpr std::size_t kBox2d3Corners = 8;
/// Points that a loop of Box2D 3 must have.
constexpr std::size_t kBox2d3ChainPoints = 4;

std::string lackOfShape(PeerEngine engine, const ShapeDescription& shape) {
    const auto* const chain = std::get_if<ChainGeometry>(&shape.geometry);
    if (engine == PeerEngine::box2d3 && chain != nullptr &&
        (!chain->loop || chain->points.size() < kBox2d3ChainPoints || shape.radius > 0)) {
        return "chains but thin loops of four points or more";
    }
    const auto* const polygon = std::get_if<PolygonGeometry>(&shape.geometry);
    if (engine == PeerEngine::box2d3 && polygon != nullptr && polygon->points.size() > kBox2d3Corners) {
        return "polygons of more than eight corners";
    }
    if (engine != PeerEngine::chipmunk) { return ""; }
    if (shape.filter.group > 0) { return "groups that always collide"; }
    if (hasMixingRule(shape)) { return "mixing rules of single shapes"; }
    if (anySurface(shape, resistsRolling)) { return "rolling resistance"; }
    return anySurface(shape, isBelt) ? "surfaces that run along an outline" : "";
}

std::string lackOfBody(PeerEngine engine, const BodyDescription& body) {
    for (const ShapeDescription& shape : body.shapes) {
        if (std::string lack = lackOfShape(engine, shape); !lack.empty()) { return lack; }
    }
    if (engine != PeerEngine::chipmunk) { return ""; }
    if (!body.enabled) { return "bodies that take no part"; }
    if (body.linearDamping != 0 || body.angularDamping != 0) { return "damping of single bodies"; }
    return body.gravityScale == 1 ? "" : "gravity of single bodies";
}

struct Box2d3LackOfJoint {
    std::string operator()(const GearDescription&) const { return "gear joints"; }
    std::string operator()(const PulleyDescription&) const { return "pulley joints"; }
    std::string operator()(const WheelDescription& wheel) const {
        return wheel.springTarget ? "wheel joints whose spring has a target" : "";
    }
    /// A strength without a velocity is one that seeks a pose.
    std::string operator()(const MotorDescription& motor) const {
        const bool seeksPlace = motor.maxForce && !motor.linearVelocity;
        const bool seeksAngle = motor.maxTorque && !motor.angularVelocity;
        return seeksPlace || seeksAngle ? "motor joints to a pose" : "";
    }
    template <class Other>
    std::string operator()(const Other&) const {
        return "";
    }
};

std::string lackOfJoint(PeerEngine engine, const JointDescription& joint) {
    if (joint.breakForce || joint.breakTorque) { return "joints that break"; }
    if (engine == PeerEngine::box2d3) { return std::visit(Box2d3LackOfJoint{}, joint.joint); }
    const auto* const revolute = std::get_if<RevoluteDescription>(&joint.joint);
    const auto* const distance = std::get_if<DistanceDescription>(&joint.joint);
    const auto* const weld = std::get_if<WeldDescription>(&joint.joint);
    if (revolute == nullptr && distance == nullptr && weld == nullptr) {
        return "joints other than revolute, distance and weld";
    }
    const bool isSoft = (revolute != nullptr && revolute->hertz) || (distance != nullptr && distance->hertz) ||
                        (weld != nullptr && (weld->linearHertz || weld->angularHertz));
    return isSoft ? "springs of a given frequency" : "";
}

const std::vector<std::string> kBox2d3Ways{
    "All state is in float, world positions too.",
    "Penetrations, joint errors, contacts, events and impacts within the step are not reported.",
    "Contacts and joints are springs of 30 and 60 Hz, or of a quarter of the sub-step rate when stiff.",
    "Bodies turn by no more than an eighth turn a step and move no faster than 400 m/s.",
    "Impacts slower than 1 m/s do not bounce.",
    "A spring goes by the mass that its part of a joint would move alone: those of hinges and welds are softer.",
    "Motor joints keep the axes along which they drive; mouse joints are springs of motor joints.",
    "A body that meets something within the step loses the rest of the step.",
    "Profile, relax passes and continuous modes other than off are ignored."};
const std::vector<std::string> kChipmunkWays{
    "Penetrations, joint errors, contacts, events and impacts within the step are not reported.",
    "There is no continuous collision: what is fast passes through.",
    "There are no sub-steps: one step with ten iterations unless said.",
    "Shapes may overlap by 0.1 m before they are pushed apart, the engine's default.",
    "Friction and restitution of a pair are products: each shape has the root of its own.",
    "Edges of a chain collide on both sides.",
    "The continuous mode, bullets and profile are ignored."};

}  // namespace

const char* peerName(PeerEngine engine) {
    switch (engine) {
        case PeerEngine::box2d2:
            return "Box2D";
        case PeerEngine::box2d3:
            return "Box2D 3";
        case PeerEngine::chipmunk:
            return "Chipmunk";
    }
    return "";  // unreachable, but GCC cannot know
}

bool hasPeer(PeerEngine engine) {
#ifdef SWEPT_PEER_BOX2D3
    if (engine == PeerEngine::box2d3) { return true; }
#endif
#ifdef SWEPT_PEER_CHIPMUNK
    if (engine == PeerEngine::chipmunk) { return true; }
#endif
    return engine == PeerEngine::box2d2;
}

std::string peerLacks(PeerEngine engine, const SceneDescription& scene) {
    if (engine == PeerEngine::box2d2) { return ""; }
    for (const BodyDescription& body : scene.bodies) {
        if (std::string lack = lackOfBody(engine, body); !lack.empty()) { return lack; }
    }
    for (const JointDescription& joint : scene.joints) {
        if (std::string lack = lackOfJoint(engine, joint); !lack.empty()) { return lack; }
    }
    return hasPeer(engine) ? "" : "place in this build";
}

std::vector<std::string> peerApproximations(PeerEngine engine, const SceneDescription& scene) {
    if (engine == PeerEngine::box2d2) { return box2dApproximations(scene); }
    return engine == PeerEngine::box2d3 ? kBox2d3Ways : kChipmunkWays;
}

}  // namespace swept
