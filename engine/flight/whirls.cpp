#include "whirls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../shapes/distance.h"
#include "../../shapes/polygon.h"
#include "../bodies/awake.h"
#include "../containers/boxed_items.h"
#include "../solve/joint_place.h"
#include "../solve/rest_springs.h"
#include "../state/profile.h"
#include "bullet_start.h"
#include "bullets_ahead.h"
#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Radians within the step, from which on a body whirls.
constexpr double kLeastTurn = 4 * kWhirlTurn;
/// Bullets in its way, and members of its island: each part of the step moves all of them.
constexpr int kMostMet = 16;
constexpr std::size_t kMostMembers = 32;

/// How fast a hinge may turn within the step one way, and how far it may get, radians.
struct Swing {
    double spin = 0;
    double room = std::numeric_limits<double>::infinity();

    double turnIn(double dt) const { return std::min(spin * dt, room); }
};

/// Of the body that a hinge holds to what is not dynamic; `kNoIndex`: it is none that may whirl.
std::uint32_t turningBody(const WorldState& world, const JointTie& tie) {
    if (!tie.isHinge) { return kNoIndex; }
    const bool isB = world.bodies[tie.bodyB].isDynamic();
    if (isB && world.bodies[tie.bodyA].isDynamic()) { return kNoIndex; }
    const std::uint32_t slot = isB ? tie.bodyB : tie.bodyA;
    return world.bodies[slot].holdingJoints == 1 && world.bodies[slot].inverseInertia > 0 ? slot : kNoIndex;
}

/// 1 / (kg·m²), about the hinge.
double inverseInertiaAbout(const Body& body, Vec2 localAnchor) {
    const auto arm = static_cast<double>(length(localAnchor - body.localCenter));
    return 1 / (arm * arm / static_cast<double>(body.inverseMass) + 1 / static_cast<double>(body.inverseInertia));
}

/// What pushed as the last step ended, and is no faster than a whirl turns in half of a part, is blocked: it presses a
/// ball against a wall. Parts may have sub-steps of a sixteenth; what bears no more than its own weight pushes by less.
/// @param impulse  of the last sub-step; @param most  of what it pushes with now, in one of the usual ones
bool isBlocked(double impulse, double most, double spin, double dt) {
    constexpr double kLeastPart = 1.0 / 32;
    return impulse > kLeastPart * most && spin * dt < kWhirlTurn / 2;
}

/// A motor brings it to its speed at most, a torque goes on.
double motorSpin(const AngularMotor& motor, double way, double spin, double gain) {
    const double speed = way * static_cast<double>(motor.speed);
    return speed > 0 ? std::max(spin, std::min(speed, spin + gain * static_cast<double>(motor.maxTorque))) : spin;
}

/// From where it is to where it pulls to.
double springSpin(const Spring& spring, double stretch, double dt) {
    const double rate = 2 * std::numbers::pi * static_cast<double>(spring.hertz);
    return rate * std::max(stretch, 0.0) * std::min(rate * dt, 1.0);
}

/// rad/s of what the hinge holds it to.
double spinOfBase(const WorldState& world, const Joint& joint, bool isB) {
    return static_cast<double>(world.motions[isB ? joint.bodyA : joint.bodyB].angularVelocity);
}

/// Relative to what the hinge holds it to. @param way  1: towards the upper limit, -1: towards the lower one
Swing swingOf(const WorldState& world, const Joint& joint, std::uint32_t slot, double way, double dt) {
    const RevoluteJointDef& def = std::get_if<HingePart>(&joint.parts)->def;
    const Body& body = world.bodies[slot];
    const bool isB = joint.bodyB == slot;
    const double gain = dt * inverseInertiaAbout(body, isB ? joint.localAnchorB : joint.localAnchorA);
    const double side = isB ? way : -way;
    const double spin =
        side * (static_cast<double>(world.motions[slot].angularVelocity) - spinOfBase(world, joint, isB));
    const Vec2 arm =
        rotate(world.motions[slot].pose.rotation, body.localCenter - (isB ? joint.localAnchorB : joint.localAnchorA));
    const double torque =
        static_cast<double>(body.torque) + body.mass * static_cast<double>(cross(arm, accelerationOf(world, body)));
    Swing swing{.spin = std::max(spin + gain * side * torque, 0.0)};
    const double subStep = dt / subStepsOf(world.settings);
    if (def.motor) {
        const double most = subStep * static_cast<double>(def.motor->maxTorque);
        const bool isStuck = isBlocked(way * static_cast<double>(joint.hinge.motor), most, spin, dt);
        if (!isStuck) { swing.spin = motorSpin(*def.motor, way, swing.spin, gain); }
    }
    const double angle = angleOf(world, joint);
    if (def.spring) {
        const double stretch = way * (static_cast<double>(springTargetOf(def)) - angle);
        const double spun = springSpin(*def.spring, stretch, dt);
        const double most = subStep * spun / gain;
        const bool isStuck = isBlocked(way * static_cast<double>(joint.hinge.spring), most, spin, dt);
        if (!isStuck) { swing.spin = std::hypot(swing.spin, spun); }
    }
    if (def.limits) {
        const double end = static_cast<double>(way > 0 ? def.limits->upper : def.limits->lower);
        swing.room = std::max(way * (end - angle), 0.0);
    }
    return swing;
}

DVec2 pivotOf(const WorldState& world, const Whirl& whirl) {
    return apply(world.motions[whirl.body].pose, whirl.localPivot);
}

/// Metres that any point of it is from its pivot, at most.
Real reachOf(const Body& body, Vec2 localPivot) { return length(localPivot - body.localCenter) + body.radius; }

Aabb boxOf(const WorldState& world, const Whirl& whirl) {
    const DVec2 pivot = pivotOf(world, whirl);
    const auto reach = static_cast<double>(reachOf(world.bodies[whirl.body], whirl.localPivot));
    return boxOfPath({.localCenter = {}, .c0 = pivot, .c1 = pivot, .a0 = 0, .a1 = 0}, reach);
}

/// Whether it comes near all that is within a hull while it turns.
/// @param hull  world axes, from the pivot
bool sweepsOver(const WorldState& world, const Whirl& whirl, const Polygon& hull) {
    const std::vector<std::uint32_t>& shapes = world.bodies[whirl.body].shapes;
    for (double turned = 0;; turned += kLeastTurn) {
        const Rotation rotation =
            rotationFromAngle(world.motions[whirl.body].angle + whirl.way * std::min(turned, whirl.turn));
        const Transform pose{.translation = -rotate(rotation, whirl.localPivot), .rotation = rotation};
        const bool meets = std::any_of(shapes.begin(), shapes.end(), [&](std::uint32_t index) {
            const Shape& shape = world.shapes[index];
            return !shape.def.sensor && !(distance(hull, shape.polygon, pose).distance > 0);
        });
        if (meets) { return true; }
        if (!(turned < std::min(whirl.turn, 2 * std::numbers::pi))) { return false; }
    }
}

bool isInTheWay(const WorldState& world, const Whirl& whirl, std::uint32_t bullet, Real dt) {
    const DVec2 pivot = pivotOf(world, whirl);
    const Sweep path = straightPath(world, bullet, dt);
    const Vec2 from = toReal(path.c0 - pivot);
    const Vec2 to = toReal(path.c1 - pivot);
    // Between two of the angles that are looked at it is no farther from the nearer one.
    const Real between = static_cast<Real>(kLeastTurn / 2) * reachOf(world.bodies[whirl.body], whirl.localPivot);
    const Real radius = world.bodies[bullet].radius + between;
    const Result<Polygon> hull = from == to ? makeCircle(from, radius) : makeCapsule(from, to, radius);
    return !hull.ok() || sweepsOver(world, whirl, hull.value());
}

void listWhirls(WorldState& world, double dt) {
    std::vector<Whirl>& whirls = world.bulletWork.whirls;
    for (const std::uint32_t index : world.activeJoints) {
        const std::uint32_t slot = turningBody(world, world.jointTies[index]);
        if (slot == kNoIndex) { continue; }
        const Joint& joint = world.joints[index];
        const bool isB = joint.bodyB == slot;
        const Swing up = swingOf(world, joint, slot, 1, dt);
        const Swing down = swingOf(world, joint, slot, -1, dt);
        const double base = spinOfBase(world, joint, isB);
        const double carried = (isB ? base : -base) * dt;
        const double turnUp = up.turnIn(dt) + carried;
        const double turnDown = down.turnIn(dt) - carried;
        const bool isUp = turnUp > turnDown;
        const double turn = isUp ? turnUp : turnDown;
        if (!(turn > kLeastTurn)) { continue; }
        Whirl& whirl = whirls.emplace_back();
        whirl.body = slot;
        whirl.localPivot = isB ? joint.localAnchorB : joint.localAnchorA;
        whirl.way = isUp == isB ? 1.0 : -1.0;
        whirl.spin = (isUp ? up : down).spin + whirl.way * base;
        whirl.turn = turn;
        whirl.box = boxOf(world, whirl);
        if (!overlaps(whirl.box, whirl.box)) { whirls.pop_back(); }  // no number
    }
    std::sort(whirls.begin(), whirls.end(), [](const Whirl& a, const Whirl& b) { return a.body < b.body; });
}

/// Bullets near whirls: those that sleep or are slow by their boxes, fast ones by their paths.
void listNear(WorldState& world, Real dt) {
    BulletWork& work = world.bulletWork;
    std::vector<WhirlMeeting>& near = work.nearWhirls;
    near.clear();
    work.whirlBoxes.clear();
    for (const Whirl& whirl : work.whirls) { work.whirlBoxes.push_back(whirl.box); }
    world.broadphase->queryDynamic(work.whirlBoxes, [&](std::size_t i, ProxyId id) {
        const std::uint32_t slot = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]].body;
        if (isBullet(world, slot)) { near.push_back({static_cast<std::uint32_t>(i), slot}); }
    });
    world.flightScratch.resize(std::max<std::size_t>(world.flightScratch.size(), 1));
    std::vector<BoxedItem>& movers = world.flightScratch[0].movers;
    movers.clear();
    const auto whirls = static_cast<std::uint32_t>(work.whirls.size());
    for (std::uint32_t i = 0; i < whirls; ++i) { movers.push_back({work.whirls[i].box, i, true}); }
    for (const std::uint32_t slot : world.awake) {
        if ((world.traits[slot] & kIsFast) == 0 || !isBullet(world, slot)) { continue; }
        const Aabb box = boxAhead(world, slot, dt);
        if (overlaps(box, box)) { movers.push_back({box, whirls + slot, false}); }
    }
    forEachOverlap(movers, [&](std::uint32_t whirl, std::uint32_t other) {
        if (other >= whirls) { near.push_back({whirl, other - whirls}); }
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
}

/// Leaves those that are in the way, and counts them.
void findMet(WorldState& world, Real dt) {
    std::vector<Whirl>& whirls = world.bulletWork.whirls;
    std::vector<WhirlMeeting>& near = world.bulletWork.nearWhirls;
    std::erase_if(near, [&](const WhirlMeeting& pair) {
        const Whirl& whirl = whirls[pair.whirl];
        return whirl.body == pair.bullet || !mayBodiesTouch(world, whirl.body, pair.bullet) ||
               !isInTheWay(world, whirl, pair.bullet, dt);
    });
    for (const WhirlMeeting& pair : near) { ++whirls[pair.whirl].met; }
}

/// What meets nobody does not whirl, and what meets a crowd strikes each on its own.
bool meetsSome(const Whirl& whirl) { return whirl.met > 0 && whirl.met <= kMostMet; }

void tieMet(WorldState& world) {
    BulletWork& work = world.bulletWork;
    for (const WhirlMeeting& pair : work.nearWhirls) {
        const Whirl& whirl = work.whirls[pair.whirl];
        if (!meetsSome(whirl)) { continue; }
        wake(world, pair.bullet);
        work.ahead.push_back({whirl.body, pair.bullet});
    }
    std::erase_if(work.whirls, [](const Whirl& whirl) { return !meetsSome(whirl); });
    for (const Whirl& whirl : work.whirls) {
        world.bodies[whirl.body].fast = true;
        BodyTraits& traits = world.traits[whirl.body];
        traits = static_cast<BodyTraits>((traits | kIsFast) & ~kIsStill);
    }
}

const Whirl* whirlAt(const WorldState& world, std::uint32_t slot) {
    const std::vector<Whirl>& whirls = world.bulletWork.whirls;
    const auto place = std::lower_bound(whirls.begin(), whirls.end(), slot,
                                        [](const Whirl& whirl, std::uint32_t body) { return whirl.body < body; });
    return place != whirls.end() && place->body == slot ? &*place : nullptr;
}

}  // namespace

void findWhirls(WorldState& world, Real dt) {
    listWhirls(world, static_cast<double>(dt));
    if (world.bulletWork.whirls.empty()) { return; }
    listNear(world, dt);
    findMet(world, dt);
    tieMet(world);
}

bool isWhirl(const WorldState& world, std::uint32_t slot) { return whirlAt(world, slot) != nullptr; }

double fastestWhirl(const WorldState& world, std::span<const std::uint32_t> members) {
    if (world.bulletWork.whirls.empty() || members.size() > kMostMembers) { return 0; }
    double fastest = 0;
    for (const std::uint32_t slot : members) {
        const Whirl* const whirl = whirlAt(world, slot);
        if (whirl != nullptr) { fastest = std::max(fastest, whirl->spin); }
    }
    return fastest;
}

}  // namespace swept::inline SWEPT_PRECISION
