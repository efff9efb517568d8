#include "../world_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../bodies/line_skin.h"
#include "../state/world_state.h"
#include "../world.h"
#include "json_text.h"
#include "scene_joints.h"
#include "scene_places.h"
#include "surfaces.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::array kBodyTypes{"static", "kinematic", "dynamic"};
constexpr std::array kContinuousModes{"off", "speedLimit", "speculative", "stop", "subStep"};
constexpr std::array kProfiles{"accurate", "fast"};
constexpr std::array kMixingRules{"usual", "geometricMean", "average", "minimum", "product", "maximum"};
constexpr std::array kBroadphases{"automatic", "allPairs", "sortAndSweep", "quadtree", "grid", "bvh", "wideBvh"};

static_assert(kBodyTypes.size() == static_cast<std::size_t>(BodyType::dynamic) + 1);
static_assert(kContinuousModes.size() == static_cast<std::size_t>(ContinuousMode::subStep) + 1);
static_assert(kProfiles.size() == static_cast<std::size_t>(Profile::fast) + 1);
static_assert(kMixingRules.size() == static_cast<std::size_t>(MixingRule::maximum) + 1);
static_assert(kBroadphases.size() == static_cast<std::size_t>(BroadphaseKind::wideBvh) + 1);

/// kg: of what is dynamic, and has none, as the engine lets it be until it is stepped. The reader wants some.
constexpr Real kLeastMass = Real(1e-6);

template <class Names, class Enumeration>
const char* wordFor(const Names& names, Enumeration value) {
    return names[static_cast<std::size_t>(value)];
}

void appendSettings(std::string& text, const WorldState& world) {
    const WorldSettings& settings = world.settings;
    const WorldSettings usual{};
    JsonObject out(text);
    if (world.lastDt > 0) { out.add("dt", world.lastDt); }
    if (settings.profile != usual.profile) { out.add("profile", wordFor(kProfiles, settings.profile)); }
    if (settings.subSteps) { out.add("subSteps", *settings.subSteps); }
    if (settings.relaxPasses) { out.add("relaxPasses", *settings.relaxPasses); }
    if (settings.continuous != usual.continuous) {
        out.add("continuous", wordFor(kContinuousModes, settings.continuous));
    }
    out.addUnless("maxImpacts", settings.maxImpacts, usual.maxImpacts);
    out.addUnless("maxSpeed", settings.maxSpeed, usual.maxSpeed);
    out.addUnless("maxPenetration", settings.maxPenetration, usual.maxPenetration);
    out.addUnless("maxJointError", settings.maxJointError, usual.maxJointError);
    out.addUnless("maxLostTime", settings.maxLostTime, usual.maxLostTime);
    if (settings.toiTolerance) { out.add("toiTolerance", *settings.toiTolerance); }
    out.addUnless("sleep", settings.sleep, usual.sleep);
    out.addUnless("sleepSpeed", settings.sleepSpeed, usual.sleepSpeed);
    if (settings.broadphase != usual.broadphase) { out.add("broadphase", wordFor(kBroadphases, settings.broadphase)); }
    out.close();
}

/// What is not as usual.
void addSurface(JsonObject& out, const Surface& surface, const Surface& usual) {
    out.addUnless("friction", surface.friction, usual.friction);
    out.addUnless("restitution", surface.restitution, usual.restitution);
    out.addUnless("rollingResistance", surface.rollingResistance, usual.rollingResistance);
    out.addUnless("surfaceSpeed", surface.surfaceSpeed, usual.surfaceSpeed);
    if (surface.frictionMixing != usual.frictionMixing) {
        out.add("frictionMixing", wordFor(kMixingRules, surface.frictionMixing));
    }
    if (surface.restitutionMixing != usual.restitutionMixing) {
        out.add("restitutionMixing", wordFor(kMixingRules, surface.restitutionMixing));
    }
}

/// Of the segments of a chain, if not all are as that of the first one, which is that of the shape.
void addSurfaces(JsonObject& out, const WorldState& world, const Shape& head) {
    const Surface usual = surfaceOf(head.def);
    std::string texts;
    bool areAlike = true;
    const Shape* segment = &head;
    for (const char* before = "["; segment != nullptr; before = ", ") {
        const Surface surface = surfaceOf(segment->def);
        areAlike = areAlike && actAlike(surface, usual);
        texts += before;
        JsonObject own(texts);
        addSurface(own, surface, usual);
        own.close();
        segment = segment->nextInChain == kNoIndex ? nullptr : &world.shapes[segment->nextInChain];
    }
    if (!areAlike) { out.begin("surfaces") += texts + ']'; }
}

/// The points of a chain, from its first segment on.
void addChain(JsonObject& out, const WorldState& world, const Shape& head) {
    std::vector<Vec2> points{head.segment.p};
    const Shape* last = &head;
    for (;;) {
        points.push_back(last->segment.q);
        if (last->nextInChain == kNoIndex) { break; }
        last = &world.shapes[last->nextInChain];
    }
    const ChainSegment& first = head.segment;
    const ChainSegment& end = last->segment;
    // An open one whose neighbours are its own points is one that is closed.
    const bool isLoop = points.size() > 3 && points.front() == points.back() && first.hasBefore && end.hasAfter &&
                        first.before == end.p && end.after == first.q;
    if (isLoop) { points.pop_back(); }
    JsonObject chain(out.begin("chain"));
    chain.add("points", std::span<const Vec2>(points));
    chain.addUnless("loop", isLoop, false);
    if (!isLoop && first.hasBefore) { chain.add("before", first.before); }
    if (!isLoop && end.hasAfter) { chain.add("after", end.after); }
    addSurfaces(chain, world, head);
    chain.close();
    out.addUnless("radius", first.radius, Real(0));
}

void addPolygon(JsonObject& out, const Polygon& polygon) {
    const std::span<const Vec2> points(polygon.vertices.data(), static_cast<std::size_t>(polygon.count));
    if (points.size() > 2) {
        out.add("polygon", points);
        out.addUnless("radius", polygon.radius, Real(0));
        return;
    }
    if (points.size() == 2 && !(polygon.radius > 0)) { return out.add("segment", points); }
    JsonObject round(out.begin(points.size() == 1 ? "circle" : "capsule"));
    if (points.size() == 1) {
        round.addUnless("center", points[0], Vec2{});
    } else {
        round.add("points", points);
    }
    round.add("radius", polygon.radius);
    round.close();
}

void appendShape(std::string& text, const WorldState& world, const Shape& shape) {
    const ShapeDef& def = shape.def;
    const ShapeDef usual{};
    JsonObject out(text);
    if (shape.isChainSegment) {
        addChain(out, world, shape);
    } else {
        addPolygon(out, givenPolygon(shape));
    }
    out.addUnless("density", def.density, usual.density);
    addSurface(out, surfaceOf(def), surfaceOf(usual));
    out.addUnless("sensor", def.sensor, false);
    if (!(def.filter == usual.filter)) {
        JsonObject filter(out.begin("filter"));
        filter.addUnless("category", def.filter.category, usual.filter.category);
        filter.addUnless("mask", def.filter.mask, usual.filter.mask);
        filter.addUnless("group", def.filter.group, usual.filter.group);
        filter.close();
    }
    out.close();
}

/// What replaces the mass of the shapes. (Of others than dynamic bodies it counts for nothing, and the reader refuses
/// it.)
void addMass(JsonObject& out, const Body& body) {
    if (body.def.mass > 0) {
        out.add("mass", body.def.mass);
    } else if (!(body.mass > 0)) {
        out.add("mass", kLeastMass);
    }
    if (body.def.inertia > 0) { out.add("inertia", body.def.inertia); }
}

void appendBody(std::string& text, const World& world, const WorldState& state, BodyId id, const ScenePlaces& places) {
    const BodyDef def = world.definition(id);
    const BodyDef usual{};
    JsonObject out(text);
    const std::string& name = places.bodyWords.given(places.bodies[id.index]);
    if (!name.empty()) { out.add("name", name); }
    out.add("type", wordFor(kBodyTypes, def.type));
    out.add("position", def.position);
    out.addUnless("angle", def.angle, usual.angle);
    out.addUnless("velocity", def.velocity, usual.velocity);
    const bool mayTurn = def.type != BodyType::dynamic || state.bodies[id.index].inverseInertia > 0;
    if (mayTurn) { out.addUnless("angularVelocity", def.angularVelocity, usual.angularVelocity); }
    out.addUnless("bullet", def.bullet, false);
    out.addUnless("fixedRotation", def.fixedRotation || !mayTurn, false);
    out.addUnless("linearDamping", def.linearDamping, usual.linearDamping);
    out.addUnless("angularDamping", def.angularDamping, usual.angularDamping);
    out.addUnless("gravityScale", def.gravityScale, usual.gravityScale);
    if (def.type == BodyType::dynamic && def.enabled) { out.addUnless("awake", def.awake, true); }
    out.addUnless("allowSleep", def.allowSleep, true);
    out.addUnless("enabled", def.enabled, true);
    if (def.continuous) { out.add("continuous", wordFor(kContinuousModes, *def.continuous)); }
    if (def.type == BodyType::dynamic) { addMass(out, state.bodies[id.index]); }
    std::string& shapes = out.begin("shapes");
    const char* before = "[";
    world.visitShapes(id, [&](ShapeId shape) {
        shapes += before;
        before = ", ";
        appendShape(shapes, state, state.shapes[shape.index]);
    });
    shapes += *before == '[' ? "[]" : "]";
    out.close();
}

/// Between brackets, one to a line.
template <class Id, class Append>
void appendList(std::string& text, const std::vector<Id>& ids, const Append& append) {
    text += '[';
    const char* before = "\n  ";
    for (const Id id : ids) {
        text += before;
        before = ",\n  ";
        append(id);
    }
    text += ']';
}

}  // namespace

std::string sceneOf(const World& world, const SceneNames& names) {
    const WorldState& state = *world.state_;
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;
    std::vector<std::uint32_t> placesOfBodies(state.bodies.slotCount());
    std::vector<std::uint32_t> placesOfJoints(state.joints.slotCount());
    std::vector<std::string> bodyNames;
    std::vector<std::string> jointNames;
    world.visitBodies([&](BodyId id) {
        placesOfBodies[id.index] = static_cast<std::uint32_t>(bodies.size());
        bodies.push_back(id);
        bodyNames.push_back(names.ofBody ? names.ofBody(id) : std::string());
    });
    world.visitJoints([&](JointId id) {
        if (!isInScene(state, state.joints[id.index])) { return; }
        placesOfJoints[id.index] = static_cast<std::uint32_t>(joints.size());
        joints.push_back(id);
        jointNames.push_back(names.ofJoint ? names.ofJoint(id) : std::string());
    });
    const ScenePlaces places{.bodies = std::move(placesOfBodies),
                             .joints = std::move(placesOfJoints),
                             .bodyWords = {"body", std::move(bodyNames)},
                             .jointWords = {"joint", std::move(jointNames)}};
    std::string text;
    JsonObject scene(text);
    if (!names.scene.empty()) { scene.add("name", names.scene); }
    scene.add("gravity", state.settings.gravity);
    appendSettings(scene.begin("settings"), state);
    scene.begin("bodies", "\n ");
    appendList(text, bodies, [&](BodyId id) { appendBody(text, world, state, id, places); });
    scene.begin("joints", "\n ");
    appendList(text, joints, [&](JointId id) { appendJoint(text, state, id, places); });
    scene.close();
    text += '\n';
    return text;
}

}  // namespace swept::inline SWEPT_PRECISION
