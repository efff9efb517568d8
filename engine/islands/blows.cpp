#include "blows.h"

#include <algorithm>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// In larger islands a blow that comes now and then would cost more than it hurts.
constexpr std::uint32_t kMostStruck = 64;
/// What closes in slower than in a fall of half of this part of the extent is no blow; without gravity, what takes more
/// than so many steps for its extent.
constexpr Real kBlowRatioOfFall = Real(1) / 16;
constexpr Real kStepsOfBlow = 128;
/// What is squeezed is pushed against the blow from a direction no farther from it than this cosine.
constexpr Real kAgainst = Real(1) / 2;
/// Bodies whose masses are no farther apart are thrown back with a twelfth of their speed at most: that is left to
/// them.
constexpr Real kMostEven = Real(3) / 2;

/// Calls `then(load, contact)` for the contacts of islands that may be struck: most of the others are passed over
/// together.
template <class Then>
void forEachSuspect(WorldState& world, const Then& then) {
    auto pair = world.touching.cbegin();
    for (const IslandContacts& run : world.islandContacts) {
        IslandLoad& load = world.islandLoads[run.root];
        const auto end = pair + run.count;
        if (load.mayBeStruck) {
            for (auto each = pair; each != end; ++each) { then(load, world.contacts[each->contact]); }
        }
        pair = end;
    }
}

bool isBlowAt(const WorldState& world, const Contact& contact, Real dt) {
    const Real speed = closingSpeedOf(world, contact, dt);
    const Real gravity = length(world.settings.gravity);
    if (!(gravity > 0)) { return speed * dt * kStepsOfBlow > contact.extent; }
    return square(speed) > kBlowRatioOfFall * gravity * contact.extent;
}

Vec2 normalOf(const WorldState& world, const Contact& contact) {
    return rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
}

/// Of several that strike a body the last one counts.
void noteBlow(WorldState& world, const Contact& contact) {
    const Vec2 normal = normalOf(world, contact);
    if (contact.dynamicA) { world.blows[contact.bodyA] = -normal; }
    if (contact.dynamicB) { world.blows[contact.bodyB] = normal; }
}

/// Whether it pushes one of its bodies back to where a blow comes from.
bool isSqueezing(const WorldState& world, const Contact& contact) {
    const Vec2 normal = normalOf(world, contact);
    const bool ofA = contact.dynamicA && dot(world.blows[contact.bodyA], -normal) < -kAgainst;
    const bool ofB = contact.dynamicB && dot(world.blows[contact.bodyB], normal) < -kAgainst;
    return ofA || ofB;
}

}  // namespace

Real closingSpeedOf(const WorldState& world, const Contact& contact, Real dt) {
    const BodyMotion& a = world.motions[contact.bodyA];
    const BodyMotion& b = world.motions[contact.bodyB];
    const Vec2 normal = rotate(a.pose.rotation, contact.manifold.normal);
    const Real fall = length(world.settings.gravity) * dt;
    Real fastest = 0;
    for (int i = 0; i < contact.manifold.count; ++i) {
        const ManifoldPoint& point = contact.manifold.points[static_cast<std::size_t>(i)];
        const DVec2 place = apply(a.pose, point.point);
        const Vec2 velocity = b.velocity + cross(b.angularVelocity, toReal(place - b.center)) - a.velocity -
                              cross(a.angularVelocity, toReal(place - a.center));
        const Real speed = -dot(velocity, normal);
        if ((speed + fall) * dt > point.separation) { fastest = std::max(fastest, speed); }
    }
    return fastest;
}

void expectBlows(IslandLoad& load, double gravity) {
    if (load.bodies < 2 || load.bodies >= kMostStruck || load.contacts < 2) { return; }
    const bool isUneven = load.heaviestLoose > kMostEven * load.lightest;
    const bool isIterated = load.effort.direct == DirectScope::none && load.effort.stir == Stir::none;
    if (!isUneven || !isIterated) { return; }
    if (load.joints > 0) { return; }
    if (load.wasStruck) { load.effort.stir = Stir::wasStruck; }
    load.mayBeStruck = load.fastest > kBlowRatioOfFall * static_cast<Real>(gravity) * load.thinnest;
}

void markStruckIslands(WorldState& world, double dt) {
    world.blows.resize(world.bodies.slotCount());
    forEachSuspect(world, [&world](const IslandLoad&, const Contact& contact) {
        world.blows[contact.bodyA] = {};
        world.blows[contact.bodyB] = {};
    });
    bool areAny = false;
    forEachSuspect(world, [&](const IslandLoad&, const Contact& contact) {
        const bool isBlow = isBlowAt(world, contact, static_cast<Real>(dt));
        areAny = areAny || isBlow;
        if (isBlow) { noteBlow(world, contact); }
    });
    if (!areAny) { return; }
    forEachSuspect(world, [&world](IslandLoad& load, const Contact& contact) {
        if (load.effort.stir != Stir::struck && isSqueezing(world, contact)) { load.effort.stir = Stir::struck; }
    });
}

}  // namespace swept::inline SWEPT_PRECISION
