#include "stirred.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "../bodies/awake.h"
#include "../bodies/body_mode.h"
#include "../bodies/world_boxes.h"
#include "../state/tolerances.h"
#include "may_touch.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// So often a step hands blows on to what is near.
constexpr int kRounds = 4;
/// What is not so many times as heavy throws nothing far.
constexpr Real kHeavy = 8;
/// What is left in the next step of one that was handed on.
constexpr Real kLeftOfBlow = Real(1) / 2;

class StirFinder {
public:
    StirFinder(WorldState& world, Real dt) : world_(world), stirs_(world.stirs), dt_(dt) {
        least_ = kStirRatio * world.leastWidth;
        stirs_.moves.resize(world.motions.size(), 0);
        stirs_.blows.resize(world.motions.size());
    }

    void find() {
        noteBlows();
        if (stirs_.strikers.empty()) { return; }
        visitPairs([this](const ContactPair& pair) { strike(pair); });
        for (const std::uint32_t slot : stirs_.strikers) { stirs_.moves[slot] = 0; }
        stirs_.strikers.clear();
        for (int i = 1; i < kRounds && !stirs_.noted.empty() && wentOn_; ++i) { handOn(); }
        for (const std::uint32_t slot : stirs_.noted) {
            stir(slot);
            stirs_.blows[slot] = {};
        }
        stirs_.noted.clear();
    }

private:
    void noteBlows() {
        for (const std::uint32_t slot : world_.awake) {
            if (!(world_.travels[slot].boxMotion > least_)) { continue; }
            const Body& body = world_.bodies[slot];
            if (!(body.inverseMass > 0) || !(kHeavy * body.inverseMass <= world_.mostInverseMass)) { continue; }
            if (!(dt_ * length(world_.motions[slot].velocity) > least_)) { continue; }  // what turns stays where it is
            noteStriker(slot);
        }
        const std::size_t own = stirs_.strikers.size();
        for (const Stirred& stirred : stirs_.bodies) {
            if (!isStirred(stirred.body)) { continue; }
            world_.glances[stirred.body].isStirred = false;
            const Blow left{kLeftOfBlow * stirred.blow.length, kLeftOfBlow * stirred.blow.mass};
            if (!(left.length > kStirRatio * world_.bodies[stirred.body].widest)) { continue; }
            noteStriker(stirred.body);
            hand(stirred.body, left);
        }
        stirs_.bodies.clear();
        for (std::size_t i = 0; i < own; ++i) { strikeAhead(stirs_.strikers[i]); }
        std::sort(stirs_.noted.begin(), stirs_.noted.end());  // in no order of a tree
    }

    /// Whom it comes to within two steps: what touches something has boxes that do not reach ahead. In the order of
    /// their slots: a striker that was struck itself carries more to who comes after.
    void strikeAhead(std::uint32_t slot) {
        const Vec2 way = kBoxStepsAhead * dt_ * world_.motions[slot].velocity;
        for (const std::uint32_t index : world_.bodies[slot].shapes) {
            const Shape& shape = world_.shapes[index];
            const Aabb box = world_.broadphase->box(shape.proxy);
            const Aabb ahead = hullOf(box, {box.lower + way, box.upper + way});
            std::vector<std::uint32_t>& met = stirs_.met;
            met.clear();
            world_.broadphase->queryDynamic(std::span(&ahead, 1), [&](std::size_t, ProxyId id) {
                const std::uint32_t other = world_.proxyShapes[static_cast<std::uint32_t>(id)];
                if (world_.shapes[other].body != slot && mayTouch(world_, shape, world_.shapes[other])) {
                    met.push_back(other);
                }
            });
            std::sort(met.begin(), met.end());
            for (const std::uint32_t other : met) {
                strike({slot, world_.shapes[other].body, shape.proxy, world_.shapes[other].proxy});
            }
        }
    }

    /// Not so if another one has its slot by now.
    bool isStirred(std::uint32_t slot) const { return world_.bodies.isAlive(slot) && world_.glances[slot].isStirred; }

    void noteStriker(std::uint32_t slot) {
        stirs_.strikers.push_back(slot);
        stirs_.moves[slot] = 1;
    }

    /// Calls `visit` with all that are near each other, and of which one is awake, or was handed a blow.
    template <class Visit>
    void visitPairs(const Visit& visit) {
        for (const ContactPair& pair : world_.probes) { visit(pair); }
        for (const ContactPair& pair : world_.candidates) { visit(pair); }
        const ParkedContacts& parked = world_.parked;
        for (std::size_t i = 0; i < stirs_.noted.size(); ++i) {  // more may come
            const Body& body = world_.bodies[stirs_.noted[i]];
            if (body.awake) { continue; }
            for (const std::uint32_t shape : body.shapes) {
                const ProxyId proxy = world_.shapes[shape].proxy;
                parked.probes.visitOf(proxy, [&](std::uint32_t place) { visit(parked.probes.all()[place]); });
                parked.candidates.visitOf(proxy, [&](std::uint32_t place) { visit(parked.candidates.all()[place]); });
            }
        }
    }

    /// Of bodies that meet, by what they do themselves.
    void strike(const ContactPair& pair) {
        if ((stirs_.moves[pair.bodyA] | stirs_.moves[pair.bodyB]) == 0) { return; }
        const bool isA = carriedBy(pair.bodyA) > carriedBy(pair.bodyB);
        const std::uint32_t heavy = isA ? pair.bodyA : pair.bodyB;
        const std::uint32_t light = isA ? pair.bodyB : pair.bodyA;
        const Vec2 velocity = world_.motions[heavy].velocity;
        const Real speed = std::min(length(velocity), length(velocity - world_.motions[light].velocity));
        handTo(pair, light, {.length = dt_ * speed, .mass = carriedBy(heavy)});
    }

    /// kg: a body that was struck goes on as what struck it.
    Real carriedBy(std::uint32_t slot) const { return std::max(massOf(world_.bodies[slot]), stirs_.blows[slot].mass); }

    void handOn() {
        wentOn_ = false;
        visitPairs([this](const ContactPair& pair) {
            const Blow ofA = stirs_.blows[pair.bodyA];
            const Blow ofB = stirs_.blows[pair.bodyB];
            if (!(ofA.length + ofB.length > 0)) { return; }
            handTo(pair, pair.bodyB, ofA);
            handTo(pair, pair.bodyA, ofB);
        });
    }

    void handTo(const ContactPair& pair, std::uint32_t slot, const Blow& blow) {
        const Body& struck = world_.bodies[slot];
        const Real least = std::max(kStirRatio * struck.widest, stirs_.blows[slot].length);
        if (!(blow.length > least) || !struck.isDynamic() || struck.def.bullet) { return; }  // bullets are swept
        const Real mass = massOf(struck);
        if (!(blow.mass >= kHeavy * mass)) { return; }
        const Blow handed{.length = blow.length / (1 + mass / blow.mass), .mass = blow.mass + mass};
        if (!(handed.length > kStirRatio * struck.widest) || !isMore(handed, stirs_.blows[slot])) { return; }
        if (isSensor(pair.proxyA) || isSensor(pair.proxyB)) { return; }
        if (modeOf(world_, struck) == ContinuousMode::speculative || areOneChain(pair)) { return; }
        hand(slot, handed);
        wentOn_ = true;
    }

    /// What joints tie together moves as they let it.
    bool areOneChain(const ContactPair& pair) const {
        const std::uint32_t lowest = lowestOfChain(pair.bodyA);
        return lowest != kNoIndex && lowest == lowestOfChain(pair.bodyB);
    }
    std::uint32_t lowestOfChain(std::uint32_t slot) const {
        if (world_.bodies[slot].holdingJoints == 0) { return kNoIndex; }
        const std::vector<JointChains::Member>& members = world_.jointChains.members;
        const auto place =
            std::lower_bound(members.begin(), members.end(), slot,
                             [](const JointChains::Member& member, std::uint32_t body) { return member.body < body; });
        return place != members.end() && place->body == slot ? place->lowest : kNoIndex;
    }

    static bool isMore(const Blow& blow, const Blow& than) {
        return blow.length > than.length || (blow.length == than.length && blow.mass > than.mass);
    }

    void hand(std::uint32_t slot, const Blow& blow) {
        Blow& noted = stirs_.blows[slot];
        if (noted.length == 0) { stirs_.noted.push_back(slot); }
        noted = blow;
    }

    static Real massOf(const Body& body) { return body.inverseMass > 0 ? 1 / body.inverseMass : 0; }

    bool isSensor(ProxyId proxy) const {
        return world_.shapes[world_.proxyShapes[static_cast<std::uint32_t>(proxy)]].def.sensor;
    }

    /// With boxes to match, if it is awake: contacts of what is not reach that far anyhow.
    void stir(std::uint32_t slot) {
        stirs_.bodies.push_back({.body = slot, .blow = stirs_.blows[slot]});
        world_.glances[slot].isStirred = true;
        if (world_.bodies[slot].heldIn != kNoIndex) { releaseHeld(world_, slot); }
        if (world_.bodies[slot].awake) { reachWithVelocity(world_, slot); }
    }

    WorldState& world_;
    Stirs& stirs_;
    Real dt_;
    Real least_ = 0;
    bool wentOn_ = true;  ///< in the last round
};

}  // namespace

void findStirred(WorldState& world, double dt) {
    if (world.awake.empty()) { return; }  // all rests: what a step costs then is little
    if (world.settings.profile == Profile::accurate) {
        StirFinder(world, static_cast<Real>(dt)).find();
        return;
    }
    for (const Stirred& stirred : world.stirs.bodies) { world.glances[stirred.body].isStirred = false; }
    world.stirs.bodies.clear();
}

}  // namespace swept::inline SWEPT_PRECISION
