#include "load_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "../contacts/contact_tests.h"
#include "../state/profile.h"
#include "../state/world_state.h"
#include "balance.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Normals steeper against gravity than this sine do not carry: 14°.
constexpr double kSideSine = 1.0 / 4;
/// Gaps and overlaps, as parts of the radius, of points that may be meant to press although what presses across them is
/// not held: islands that are solved all at once then have a first guess, and close them.
constexpr Real kGuessRatio = Real(1) / (1 << 7);
/// Of what the limits allow to be left of a load: what is aimed at, and what will do.
constexpr double kWantedShare = 1.0 / 64;
constexpr double kAcceptedShare = 1.0 / 2;
/// Rounds over the points of a body in which pushes have to come up by themselves, and what may be left of its load
/// then.
constexpr int kPressRounds = 64;
constexpr double kPressedShare = 1.0 / 32;

/// What the step that is sought for is made of.
struct LoadSearch {
    WorldState& world;
    LoadPaths& paths;
    double dt;
    double gravityStep;  ///< m/s
    double subSteps;
    DVec2 down;
};

void addTo(Wrench& load, DVec2 impulse, DVec2 arm) { load += {impulse, cross(arm, impulse)}; }

DVec2 impulseOf(const LoadPoint& point) { return point.push * point.normal + point.drag * point.tangent; }

/// A contact as one of the two bodies sees it that it holds up.
LoadPoint frameOf(const LoadSearch& search, const TouchingPair& pair, const Contact& contact, Vec2 normal) {
    LoadPoint frame{.contact = pair.contact, .friction = static_cast<double>(contact.friction)};
    const DVec2 fromA = toDouble(normal);
    const double rise = -dot(fromA, search.down);
    const bool carriesB = pair.areDynamic() ? rise > 0 : pair.dynamicB;
    frame.carried = carriesB ? pair.bodyB : pair.bodyA;
    frame.carrier = carriesB ? pair.bodyA : pair.bodyB;
    if (!pair.areDynamic()) { frame.carrier = kNoIndex; }
    frame.normal = carriesB ? fromA : -fromA;
    frame.tangent = carriesB ? toDouble(rightPerp(normal)) : -toDouble(rightPerp(normal));
    frame.isAtSide = !((carriesB ? rise : -rise) > kSideSine);
    return frame;
}

/// @return false: something is in the way of a balance, also what a torque holds that resists rolling
bool addContact(const LoadSearch& search, const TouchingPair& pair, const IslandRest& rest) {
    const WorldState& world = search.world;
    const Contact& contact = world.contacts[pair.contact];
    if (pair.rolls() && contact.rollingImpulse() != 0) { return false; }
    const BodyMotion& a = world.motions[pair.bodyA];
    const BodyMotion& b = world.motions[pair.bodyB];
    const Vec2 normal = rotate(a.pose.rotation, contact.manifold.normal);
    LoadPoint frame = frameOf(search, pair, contact, normal);
    const bool carriesB = frame.carried == pair.bodyB;
    const Vec2 originFromA = toReal(a.pose.position - a.center);
    const Vec2 fromBToA = toReal(a.center - b.center);
    const RestLimits limits = limitsOf(world, rest);
    const Real radius = movedRadius(world, pair);
    const Real widestGap = (rest.isDirect ? std::max(limits.gap, kGuessRatio) : limits.gap) * radius;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const Real separation = contact.manifold.points[i].separation;
        if (!rest.isDirect && separation < -limits.overlap * radius) { return false; }
        LoadPoint& point = search.paths.points.emplace_back(frame);
        point.point = static_cast<std::uint8_t>(i);
        const Vec2 armA = rotate(a.pose.rotation, contact.manifold.points[i].point) + originFromA;
        const Vec2 armB = armA + fromBToA;
        point.armOfCarried = toDouble(carriesB ? armB : armA);
        point.armOfCarrier = toDouble(carriesB ? armA : armB);
        if (separation > widestGap) {
            point.carried = kNoIndex;
            continue;
        }
        point.push = search.subSteps * static_cast<double>(contact.normalImpulse[i]);
        point.drag = search.subSteps * static_cast<double>(contact.tangentImpulse[i]);
    }
    return true;
}

/// Points of the islands in question; bodies with their pulls, and with what goes on pushing them as it does.
void listPoints(const LoadSearch& search) {
    WorldState& world = search.world;
    LoadPaths& paths = search.paths;
    paths.points.clear();
    for (std::uint32_t place = 0; place < world.tied.size(); ++place) {
        const std::uint32_t slot = world.tied[place];
        const Body& body = world.bodies[slot];
        paths.places[slot] = place;
        paths.loads[slot] = {(body.mass * search.dt) * toDouble(accelerationOf(world, body)), 0};
        paths.waiting[slot] = 0;
    }
    for (const TouchingPair& pair : world.touching) {
        if (!isTied(world, pair)) { continue; }
        IslandRest& rest = restOf(world, pair.dynamicBody());
        if (rest.isSought) { rest.isSought = addContact(search, pair, rest); }
    }
    for (const LoadPoint& point : paths.points) {
        if (point.carried == kNoIndex || point.carrier == kNoIndex) { continue; }
        if (point.isAtSide) {
            addTo(paths.loads[point.carried], impulseOf(point), point.armOfCarried);
            addTo(paths.loads[point.carrier], -impulseOf(point), point.armOfCarrier);
        } else {
            ++paths.waiting[point.carrier];
        }
    }
}

/// Those that may change stand together, by the body that they carry, in their order; the others behind them.
void sortPoints(const LoadSearch& search) {
    LoadPaths& paths = search.paths;
    const std::size_t bodies = search.world.tied.size();
    const auto placeOf = [&paths, bodies](const LoadPoint& point) {
        const bool stays = point.carried == kNoIndex || (point.isAtSide && point.carrier != kNoIndex);
        return stays ? bodies : static_cast<std::size_t>(paths.places[point.carried]);
    };
    paths.firstPoint.assign(bodies + 2, 0);
    for (const LoadPoint& point : paths.points) { ++paths.firstPoint[placeOf(point) + 1]; }
    for (std::size_t i = 0; i <= bodies; ++i) { paths.firstPoint[i + 1] += paths.firstPoint[i]; }
    paths.spare.resize(paths.points.size());
    for (const LoadPoint& point : paths.points) { paths.spare[paths.firstPoint[placeOf(point)]++] = point; }
    for (std::size_t i = bodies + 1; i > 0; --i) { paths.firstPoint[i] = paths.firstPoint[i - 1]; }
    paths.firstPoint[0] = 0;
    std::swap(paths.points, paths.spare);
}

Wrench overLever(const Wrench& load, double lever) { return {load.force, lever > 0 ? load.twist / lever : 0}; }

/// @param withSides  whether points at the side may change, too
/// @return whether the points hold the body
bool balanceBody(const LoadSearch& search, std::uint32_t slot, std::span<LoadPoint> points, bool withSides) {
    const Body& body = search.world.bodies[slot];
    const RestLimits limits = limitsOf(search.world, restOf(search.world, slot));
    const auto lever = static_cast<double>(body.radius);
    ConeBalance& balance = search.paths.balance;
    Wrench load = search.paths.loads[slot];
    balance.clear();
    for (const LoadPoint& point : points) {
        if (point.isAtSide && !withSides) {
            addTo(load, impulseOf(point), point.armOfCarried);
            continue;
        }
        const double drag = point.friction > 0 ? point.drag / point.friction : 0;
        for (const double side : {1.0, -1.0}) {
            Wrench edge;
            addTo(edge, point.normal + (side * point.friction) * point.tangent, point.armOfCarried);
            balance.addEdge(overLever(edge, lever), 0.5 * (point.push + side * drag));
        }
    }
    const double most = body.mass * search.gravityStep * static_cast<double>(std::min(limits.pull, limits.torque));
    const double left = balance.solve(overLever(load, lever), body.inverseInertia > 0, kWantedShare * most);
    if (!(left <= kAcceptedShare * most)) { return false; }
    std::size_t edge = 0;
    for (LoadPoint& point : points) {
        if (point.isAtSide && !withSides) { continue; }
        const double one = balance.part(edge);
        const double other = balance.part(edge + 1);
        edge += 2;
        point.push = one + other;
        point.drag = point.friction * (one - other);
    }
    return true;
}

/// Where numbers end that come nearer to it by the same part from one to the next (Aitken 1926): what is in a steep
/// wedge is pushed to and fro by its walls, and each round leaves all but a thousandth of the load.
double limitOf(const std::array<double, 3>& numbers) {
    const double before = numbers[0] - numbers[1];
    const double after = numbers[1] - numbers[2];
    return after > 0 && before > after ? numbers[2] - after * after / (before - after) : numbers[2];
}

/// Walls on both sides could hold anything, if only they pressed hard enough: that a box which just fits between them
/// stays is a solution, too, but nothing makes them press. So each point in turn pushes as far as the load drives the
/// body into it, and rubs as far as it pushes, from what it did before on. If that leaves nothing of the load, the
/// points press because of it (as under a plank that leans on a wall), or already did.
bool doesLoadPress(const LoadSearch& search, std::uint32_t slot, std::span<const LoadPoint> points) {
    const Body& body = search.world.bodies[slot];
    Wrench left = search.paths.loads[slot];
    const double most = kPressedShare * length(left.force);
    std::vector<LoadPoint>& tried = search.paths.spare;  // has room for all
    tried.assign(points.begin(), points.end());
    for (const LoadPoint& point : tried) { addTo(left, impulseOf(point), point.armOfCarried); }
    const double byTurn = body.mass * body.inverseInertia;
    const auto stopping = [&left, byTurn](DVec2 way, DVec2 arm) {
        const double lever = cross(arm, way);
        return -(dot(left.force, way) + byTurn * left.twist * lever) / (1 + byTurn * lever * lever);
    };
    const auto change = [&left](double& impulse, double to, DVec2 way, DVec2 arm) {
        addTo(left, (to - impulse) * way, arm);
        impulse = to;
    };
    const auto leftOver = [&left, &body] {
        const double twist = body.inverseInertia > 0 ? std::fabs(left.twist) / static_cast<double>(body.radius) : 0;
        return std::max(length(left.force), twist);
    };
    std::array<double, 3> later{};  // what is left when so much of the rounds is over: a half, three quarters, all
    for (int round = 0; round < kPressRounds; ++round) {
        for (LoadPoint& point : tried) {
            const DVec2 arm = point.armOfCarried;
            change(point.push, std::max(point.push + stopping(point.normal, arm), 0.0), point.normal, arm);
            const double rub = point.friction * point.push;
            change(point.drag, std::clamp(point.drag + stopping(point.tangent, arm), -rub, rub), point.tangent, arm);
        }
        if (round + 1 == kPressRounds / 2) { later[0] = leftOver(); }
        if (round + 1 == kPressRounds / 4 * 3) { later[1] = leftOver(); }
    }
    later[2] = leftOver();
    return later[2] <= most || limitOf(later) <= most;
}

/// @return whether it could be held
bool handDown(const LoadSearch& search, std::uint32_t slot) {
    LoadPaths& paths = search.paths;
    const std::uint32_t place = paths.places[slot];
    const std::uint32_t first = paths.firstPoint[place];
    const std::span<LoadPoint> points = std::span(paths.points).subspan(first, paths.firstPoint[place + 1] - first);
    if (!balanceBody(search, slot, points, false)) {
        const auto isAtSide = [](const LoadPoint& point) { return point.isAtSide; };
        const bool hasSides = std::any_of(points.begin(), points.end(), isAtSide);
        if (!hasSides || !doesLoadPress(search, slot, points) || !balanceBody(search, slot, points, true)) {
            return false;
        }
    }
    for (const LoadPoint& point : points) {
        if (point.carrier == kNoIndex) { continue; }
        addTo(paths.loads[point.carrier], -impulseOf(point), point.armOfCarrier);
        if (--paths.waiting[point.carrier] == 0) { paths.ready.push_back(point.carrier); }
    }
    return true;
}

void handAllDown(const LoadSearch& search) {
    WorldState& world = search.world;
    std::vector<std::uint32_t>& ready = search.paths.ready;
    ready.clear();
    for (const std::uint32_t slot : world.tied) {
        if (search.paths.waiting[slot] == 0 && restOf(world, slot).isSought) { ready.push_back(slot); }
    }
    for (std::size_t i = 0; i < ready.size(); ++i) {  // grows as it goes
        IslandRest& rest = restOf(world, ready[i]);
        rest.isSought = rest.isSought && handDown(search, ready[i]);
    }
}

bool writeBack(const LoadSearch& search) {
    WorldState& world = search.world;
    bool any = false;
    for (const LoadPoint& point : search.paths.points) {
        Contact& contact = world.contacts[point.contact];
        if (!restOf(world, contact.dynamicBody()).isSought) { continue; }
        any = true;
        const auto push = static_cast<Real>(point.push / search.subSteps);
        const Real most = contact.friction * push;
        contact.normalImpulse[point.point] = push;
        contact.tangentImpulse[point.point] = std::clamp(static_cast<Real>(point.drag / search.subSteps), -most, most);
        contact.pressed = contact.pressed || push > 0;
    }
    return any;
}

}  // namespace

/// Of the cones of all points below a body; few have more.
constexpr std::size_t kEdgesAtOnce = 64;

void makeRoomForLoads(WorldState& world) {
    LoadPaths& paths = world.loadPaths;
    const std::size_t slots = world.bodies.slotCount();
    if (paths.points.capacity() < 2 * world.touching.size()) { paths.points.reserve(2 * world.touching.capacity()); }
    if (paths.spare.capacity() < paths.points.capacity()) { paths.spare.reserve(paths.points.capacity()); }
    if (paths.loads.size() < slots) { paths.loads.resize(slots); }
    if (paths.waiting.size() < slots) { paths.waiting.resize(slots); }
    if (paths.places.size() < slots) { paths.places.resize(slots); }
    if (paths.firstPoint.capacity() < slots + 2) { paths.firstPoint.reserve(slots + 2); }
    if (paths.ready.capacity() < slots) { paths.ready.reserve(slots); }
    paths.balance.reserve(kEdgesAtOnce);
}

bool handLoadsDown(WorldState& world, double dt) {
    const DVec2 gravity = toDouble(world.settings.gravity);
    const double pull = length(gravity);
    if (!(pull > 0)) { return false; }
    const LoadSearch search{.world = world,
                            .paths = world.loadPaths,
                            .dt = dt,
                            .gravityStep = pull * dt,
                            .subSteps = static_cast<double>(subStepsOf(world.settings)),
                            .down = (1 / pull) * gravity};
    listPoints(search);
    sortPoints(search);
    handAllDown(search);
    return writeBack(search);
}

}  // namespace swept::inline SWEPT_PRECISION
