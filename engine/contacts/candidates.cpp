#include "candidates.h"

#include <algorithm>
#include <cstring>

#include "../bodies/travel.h"
#include "contact_making.h"
#include "pair_boxes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Pairs per block of a parallel loop.
constexpr std::size_t kCandidateGrain = 512;

CandidateFate fateOf(const WorldState& world, std::span<const Aabb> boxes, const ContactPair& pair) {
    const bool isNear = boxesOverlap(world.neededBoxes, pair);
    if (!world.watched && !isNear && boxesOverlap(boxes, pair)) { return CandidateFate::waits; }  // as nearly always
    const BodyGlances bodies{world.glances[pair.bodyA], world.glances[pair.bodyB]};
    const bool isAsleep = bodies.a.motion < 0 && bodies.b.motion < 0;
    if (!isAsleep && !boxesOverlap(boxes, pair)) { return CandidateFate::goes; }
    const bool isContact = world.watched || (isNear && !isAsleep && !bodies.areFar());
    return isContact ? CandidateFate::becomesContact : CandidateFate::waits;
}

/// The first from a place on that does not wait: few do not.
std::size_t nextThatLeaves(std::span<const CandidateFate> fates, std::size_t from) {
    static_assert(static_cast<int>(CandidateFate::waits) == 0);
    for (std::uint64_t several = 0; from + sizeof(several) <= fates.size(); from += sizeof(several)) {
        std::memcpy(&several, fates.data() + from, sizeof(several));
        if (several != 0) { break; }
    }
    while (from < fates.size() && fates[from] == CandidateFate::waits) { ++from; }
    return from;
}

}  // namespace

void promoteCandidates(WorldState& world) {
    const std::span<const Aabb> boxes = world.broadphase->boxes();
    world.droppedPairs.clear();
    world.promoted.clear();
    world.candidateFates.resize(world.candidates.size());
    world.loops->run(world.candidates.size(), kCandidateGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            world.candidateFates[i] = fateOf(world, boxes, world.candidates[i]);
        }
    });
    std::size_t leaves = nextThatLeaves(world.candidateFates, 0);
    while (leaves < world.candidates.size()) {
        const bool goes = world.candidateFates[leaves] == CandidateFate::goes;
        (goes ? world.droppedPairs : world.promoted).push_back(world.candidates[leaves]);
        leaves = nextThatLeaves(world.candidateFates, leaves + 1);
    }
    makeContacts(world, world.promoted);
}

void closeCandidates(WorldState& world) {
    const std::span<ContactPair> candidates = world.candidates;
    std::size_t leaves = nextThatLeaves(world.candidateFates, 0);
    std::size_t kept = leaves;
    while (leaves < candidates.size()) {
        const std::size_t next = nextThatLeaves(world.candidateFates, leaves + 1);
        std::copy(&candidates[leaves] + 1, candidates.data() + next, candidates.data() + kept);
        kept += next - leaves - 1;
        leaves = next;
    }
    world.candidates.resize(kept);
    dropPairs(world, world.droppedPairs);
}

void promoteCandidatesOf(WorldState& world, FunctionRef<bool(const ContactPair&)> isMeant) {
    std::size_t kept = 0;
    for (const ContactPair& pair : world.candidates) {
        if (isMeant(pair)) {
            makeContact(world, shapeOf(world, pair.proxyA), shapeOf(world, pair.proxyB));
        } else {
            world.candidates[kept++] = pair;
        }
    }
    world.candidates.resize(kept);
}

}  // namespace swept::inline SWEPT_PRECISION
