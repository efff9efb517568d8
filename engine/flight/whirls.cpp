#include "whirls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../../shapes/distance.h"
#include "../../shapes/polygon.h"
#include "../solve/joint_place.h"
#include "../solve/rest_springs.h"
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

/// @param way  1: towards the upper limit, -1: towards the lower one
Swing swingOf(const WorldState& world, const Joint& joint, std::uint32_t slot, double way, double dt) {
    const RevoluteJointDef& def = std::get_if<HingePart>(&joint.parts)->def;
    const Body& body = world.bodies[slot];
    const bool isB = joint.bodyB == slot;
    const double gain = dt * inverseInertiaAbout(body, isB ? joint.localAnchorB : joint.localAnchorA);
    const double side = isB ? way : -way;
    const double spin = side * static_cast<double>(world.motions[slot].angularVelocity);
    Swing swing{.spin = std::max(spin + gain * side * static_cast<double>(body.torque), 0.0)};
    if (def.motor) { swing.spin = motorSpin(*def.motor, way, swing.spin, gain); }
    const double angle = angleOf(world, joint);
    if (def.spring) {
        const double stretch = way * (static_cast<double>(springTargetOf(def)) - angle);
        swing.spin = std::max(swing.spin, springSpin(*def.spring, stretch, dt));
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

/// What it may sweep in the step, and more.
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
    return hull.ok() && sweepsOver(world, whirl, hull.value());
}

void listWhirls(WorldState& world, double dt) {
    for (const std::uint32_t index : world.activeJoints) {
        const std::uint32_t slot = turningBody(world, world.jointTies[index]);
        if (slot == kNoIndex) { continue; }
        const Joint& joint = world.joints[index];
        const Swing up = swingOf(world, joint, slot, 1, dt);
        const Swing down = swingOf(world, joint, slot, -1, dt);
        const bool isUp = up.turnIn(dt) > down.turnIn(dt);
        const Swing& swing = isUp ? up : down;
        if (!(swing.turnIn(dt) > kLeastTurn)) { continue; }
        const bool isB = joint.bodyB == slot;
        world.bulletWork.whirls.push_back({.body = slot,
                                           .localPivot = isB ? joint.localAnchorB : joint.localAnchorA,
                                           .spin = swing.spin,
                                           .turn = swing.turnIn(dt),
                                           .way = isUp == isB ? 1.0 : -1.0});
    }
}

/// Bullets in the ways of whirls.
void listMet(WorldState& world, Real dt) {
    for (const std::uint32_t slot : world.awake) {
        if (!isBullet(world, slot)) { continue; }
        const Aabb box = boxAhead(world, slot, dt);
        for (Whirl& whirl : world.bulletWork.whirls) {
            if (whirl.body == slot || !overlaps(box, boxOf(world, whirl))) { continue; }
            if (!mayBodiesTouch(world, whirl.body, slot) || !isInTheWay(world, whirl, slot, dt)) { continue; }
            world.bulletWork.ahead.push_back({whirl.body, slot});
            ++whirl.met;
        }
    }
}

/// What meets nobody does not whirl, and what meets a crowd strikes each on its own.
void dropOthers(BulletWork& work) {
    const auto whirls = [](const Whirl& whirl) { return whirl.met > 0 && whirl.met <= kMostMet; };
    std::erase_if(work.ahead, [&](const BulletAhead& pair) {
        return std::any_of(work.whirls.begin(), work.whirls.end(),
                           [&](const Whirl& whirl) { return whirl.body == pair.bullet && !whirls(whirl); });
    });
    std::erase_if(work.whirls, [&](const Whirl& whirl) { return !whirls(whirl); });
}

}  // namespace

void findWhirls(WorldState& world, Real dt) {
    std::vector<Whirl>& whirls = world.bulletWork.whirls;
    whirls.clear();
    listWhirls(world, static_cast<double>(dt));
    if (whirls.empty()) { return; }
    listMet(world, dt);
    dropOthers(world.bulletWork);
    for (const Whirl& whirl : whirls) {
        world.bodies[whirl.body].fast = true;
        BodyTraits& traits = world.traits[whirl.body];
        traits = static_cast<BodyTraits>((traits | kIsFast) & ~kIsStill);
    }
}

double whirlOf(const WorldState& world, std::span<const std::uint32_t> members) {
    if (members.size() > kMostMembers) { return 0; }
    double fastest = 0;
    for (const Whirl& whirl : world.bulletWork.whirls) {
        const bool isMember = std::find(members.begin(), members.end(), whirl.body) != members.end();
        if (isMember) { fastest = std::max(fastest, whirl.spin); }
    }
    return fastest;
}

}  // namespace swept::inline SWEPT_PRECISION
