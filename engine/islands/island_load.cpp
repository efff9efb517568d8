#include "island_load.h"

#include <algorithm>
#include <limits>

#include "../bodies/body_form.h"
#include "../crew/beside.h"
#include "../state/world_state.h"
#include "contradictions.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// On the move is what is as fast as in a fall of half of this part of its extent.
constexpr Real kMovingRatioOfFall = Real(1) / 16;

BodyLoad loadOf(const Body& body, const BodyMotion& motion, DVec2 up, Real gravity) {
    const Real speedSquared = lengthSquared(motion.velocity);
    const bool isLink = body.holdingJoints > 1 || (body.holdingJoints == 1 && body.hasContact);
    const bool isStill = speedSquared == 0 && motion.angularVelocity == 0;
    return {.height = dot(up, motion.center),
            .mass = static_cast<Real>(body.mass),
            .extent = body.extent,
            .speedSquared = speedSquared,
            .debt = body.searchDebt,
            .isMoving = speedSquared > kMovingRatioOfFall * gravity * body.extent,
            // The effort is still that of the last step.
            .staysPut = isStill || body.effort.direct == DirectScope::all,
            .isJointed = body.holdingJoints > 0,
            .wasStruck = body.effort.stir == Stir::struck,
            .isLink = isLink,
            .mayCarry = isLink || (body.holdingJoints > 0 && isRound(body))};
}

/// As if its bodies were added one by one: all of these are the same in any order. @pre `more` has bodies
void addBodiesOf(IslandLoad& load, const IslandLoad& more) {
    if (load.bodies == 0) {
        load = more;
        return;
    }
    load.bodies += more.bodies;
    load.fastest = std::max(load.fastest, more.fastest);
    load.moving += more.moving;
    load.debt = std::max(load.debt, more.debt);
    load.staysPut = load.staysPut && more.staysPut;
    load.wasStruck = load.wasStruck || more.wasStruck;
    load.heaviestLoose = std::max(load.heaviestLoose, more.heaviestLoose);
    load.heaviestJointed = std::max(load.heaviestJointed, more.heaviestJointed);
    load.lightest = std::min(load.lightest, more.lightest);
    load.lightestLink = std::min(load.lightestLink, more.lightestLink);
    load.lightestCarrier = std::min(load.lightestCarrier, more.lightestCarrier);
    load.thinnest = std::min(load.thinnest, more.thinnest);
    load.lowest = std::min(load.lowest, more.lowest);
    load.highest = std::max(load.highest, more.highest);
}

void addBody(IslandLoad& load, const BodyLoad& body) {
    addBodiesOf(load, {.bodies = 1,
                       .lightest = body.mass,
                       .lightestLink = body.isLink ? body.mass : std::numeric_limits<Real>::max(),
                       .lightestCarrier = body.mayCarry ? body.mass : std::numeric_limits<Real>::max(),
                       .wasStruck = body.wasStruck,
                       .heaviestJointed = body.isJointed ? body.mass : 0,
                       .thinnest = body.extent,
                       .lowest = body.height,
                       .highest = body.height,
                       .fastest = body.speedSquared,
                       .moving = body.isMoving ? 1U : 0U,
                       .heaviestLoose = body.isJointed ? 0 : body.mass,
                       .debt = body.debt,
                       .staysPut = body.staysPut});
}

/// Bodies per block.
constexpr std::size_t kLoadBlock = 32;
/// Blocks that are worth handing over.
constexpr std::size_t kBlockGrain = 4;

/// Copied: GCC 12 fills what is so large with zeros by an instruction that is slow to begin (`rep stos`).
constexpr IslandLoad kNoLoad;

/// What is to be fetched of the bodies of a block, any worker does.
void weighBlock(WorldState& world, std::size_t block, DVec2 up, Real gravity) {
    const std::size_t begin = block * kLoadBlock;
    const std::size_t end = std::min(begin + kLoadBlock, world.tied.size());
    const std::uint32_t root = world.islands.rootOf(world.tied[begin]);
    IslandLoad load;
    std::uint32_t others = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t slot = world.tied[i];
        Body& body = world.bodies[slot];
        if (body.searchDebt > 0) { --body.searchDebt; }
        world.islandLoads[slot] = kNoLoad;
        BodyLoad own = loadOf(body, world.motions[slot], up, gravity);
        own.root = world.islands.rootOf(slot);
        if (own.root == root) {
            addBody(load, own);
        } else {
            world.bodyLoads[begin + others++] = own;
        }
    }
    world.blockLoads[block] = {root, others, load};
}

/// Counted in a register as long as they are of one island, as mostly: each count in memory waits for the one before.
void countIslandContacts(WorldState& world) {
    std::vector<IslandContacts>& runs = world.islandContacts;
    runs.clear();
    std::uint32_t root = kNoIndex;
    std::uint32_t count = 0;
    for (const TouchingPair& pair : world.touching) {
        const std::uint32_t next = world.islands.rootOf(pair.dynamicBody());
        if (next != root && count > 0) {
            runs.push_back({root, count});
            count = 0;
        }
        root = next;
        ++count;
    }
    if (count > 0) { runs.push_back({root, count}); }
}

/// Against gravity; 0 without.
DVec2 upIn(const WorldState& world) {
    const auto gravity = static_cast<double>(length(world.settings.gravity));
    return gravity > 0 ? (-1 / gravity) * toDouble(world.settings.gravity) : DVec2{};
}

/// One worker counts contacts meanwhile.
void addBodiesAndContacts(WorldState& world) {
    const auto gravity = static_cast<double>(length(world.settings.gravity));
    const DVec2 up = upIn(world);
    const std::size_t blocks = (world.tied.size() + kLoadBlock - 1) / kLoadBlock;
    world.bodyLoads.resize(world.tied.size());
    world.blockLoads.resize(blocks);
    const auto count = [&world] { countIslandContacts(world); };
    runBeside(*world.loops, count, blocks, kBlockGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) { weighBlock(world, i, up, static_cast<Real>(gravity)); }
    });
    for (std::size_t i = 0; i < blocks; ++i) {
        const BlockLoad& block = world.blockLoads[i];
        addBodiesOf(world.islandLoads[block.root], block.load);
        for (std::size_t k = 0; k < block.others; ++k) {
            const BodyLoad& body = world.bodyLoads[i * kLoadBlock + k];
            addBody(world.islandLoads[body.root], body);
        }
    }
    for (const IslandContacts& run : world.islandContacts) { world.islandLoads[run.root].contacts += run.count; }
}

/// Sums that change only when joints do: a look at each chain, not at each joint.
void addJoints(WorldState& world) {
    for (const JointChain& chain : world.jointChains.list) {
        IslandLoad& load = world.islandLoads[world.islands.find(chain.lowest)];
        load.longestChain = std::max(load.longestChain, chain.joints);
        if (chain.anchors > 0) { load.longestBeam = std::max(load.longestBeam, chain.angleJoints); }
        // What only lies on a bridge makes it no chain.
        load.hasLoop = load.hasLoop || chain.hasLoop();
        load.hasWideLoop = load.hasWideLoop || (chain.hasLoop() && !chain.isThin);
        load.isAnchored = load.isAnchored || chain.anchors > 0;
        load.joints += chain.joints;
        load.limitedHinges += chain.limitedHinges;
        load.plainJoints += chain.plainJoints;
        load.softJoints += chain.softJoints;
        load.jointsWithDrives += chain.jointsWithDrives;
        load.powered += chain.poweredJoints;
        load.holdsAngles = load.holdsAngles || chain.angleJoints > 0;
    }
}

void noteRolling(WorldState& world) {
    for (const TouchingPair& pair : world.touching) {
        if (pair.rolls()) { world.islandLoads[world.islands.rootOf(pair.dynamicBody())].resistsRolling = true; }
    }
}

}  // namespace

void findIslandLoads(WorldState& world) {
    world.islandLoads.resize(std::max<std::size_t>(world.islandLoads.size(), world.bodies.slotCount()));
    addBodiesAndContacts(world);
    if (world.rollingShapes > 0) { noteRolling(world); }
    if (!world.activeJoints.empty()) {
        addJoints(world);
        noteContradictions(world);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
