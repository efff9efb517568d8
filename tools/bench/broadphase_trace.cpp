#include "broadphase_trace.h"

#include <algorithm>

#include "broadphase_contestant.h"

namespace swept::bench {
namespace {

Aabb ahead(const Aabb& box, Vec2 way) { return hullOf(box, {box.lower + way, box.upper + way}); }

Aabb enlarge(const TightBox& tight, const ProxyTraits& traits, const MarginRule& rule) {
    constexpr float kLargestMargin = 0.05F;
    constexpr float kStaticMargin = 0.02F;
    const bool isFixed = traits.kind == ProxyKind::fixed;
    if (rule.asBox2d3) {
        return grown(tight.box, isFixed ? kStaticMargin : std::min(kLargestMargin, traits.reach / 8));
    }
    if (isFixed) { return tight.box; }
    return ahead(grown(tight.box, rule.extentRatio * traits.extent), rule.stepsAhead * tight.motion);
}

/// Pairs alive, of which some have bounds that do not overlap.
std::uint64_t countFalse(const std::vector<TracePair>& alive, const std::vector<Aabb>& bounds) {
    return static_cast<std::uint64_t>(std::count_if(
        alive.begin(), alive.end(), [&](const TracePair& pair) { return !overlaps(bounds[pair.a], bounds[pair.b]); }));
}

void follow(std::vector<Aabb>& bounds, const MotionStep& step) {
    for (const std::vector<TightBox>* const boxes : {&step.placed, &step.moved}) {
        for (const TightBox& tight : *boxes) { bounds[tight.proxy] = tight.box; }
    }
}

}  // namespace

std::uint64_t BoxTrace::timedMoves() const {
    std::uint64_t moves = 0;
    for (std::size_t i = warmSteps; i < steps.size(); ++i) {
        moves += steps[i].moved.size() + steps[i].inserted.size();
    }
    return moves;
}

BoxTrace enlarged(const Motion& motion, const MarginRule& rule) {
    BoxTrace trace;
    trace.name = motion.name;
    trace.proxies = motion.proxies;
    std::vector<Aabb> boxes(motion.proxies.size());
    for (const MotionStep& step : motion.steps) {
        TraceStep& told = trace.steps.emplace_back();
        told.removed = step.removed;
        for (const TightBox& tight : step.placed) {
            boxes[tight.proxy] = enlarge(tight, motion.proxies[tight.proxy], rule);
            told.inserted.push_back({tight.proxy, boxes[tight.proxy]});
        }
        for (const TightBox& tight : step.moved) {
            if (contains(boxes[tight.proxy], tight.box)) { continue; }
            boxes[tight.proxy] = enlarge(tight, motion.proxies[tight.proxy], rule);
            told.moved.push_back({tight.proxy, boxes[tight.proxy]});
        }
    }
    return trace;
}

std::uint64_t pairHash(const TracePair& pair) {
    std::uint64_t bits = (std::uint64_t{pair.a} << 32 | pair.b) + 0x9E3779B97F4A7C15ULL;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;  // the finaliser of splitmix64
    bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
    return bits ^ (bits >> 31);
}

TraceTruth truthOf(const Motion& motion, const BoxTrace& trace) {
    const auto reference = makeOurBroadphase(BroadphaseKind::automatic);
    reference->begin(trace.proxies);
    TraceTruth truth;
    std::vector<Aabb> bounds(trace.proxies.size());
    std::vector<Aabb> boxes(trace.proxies.size());
    std::vector<char> present(trace.proxies.size());
    std::vector<TracePair> alive;
    std::vector<TracePair> found;
    double timed = 0;
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
        const TraceStep& step = trace.steps[i];
        for (const std::uint32_t proxy : step.removed) { present[proxy] = 0; }
        for (const ProxyBox& inserted : step.inserted) { present[inserted.proxy] = 1; }
        for (const std::vector<ProxyBox>* const told : {&step.inserted, &step.moved}) {
            for (const ProxyBox& box : *told) { boxes[box.proxy] = box.box; }
        }
        follow(bounds, motion.steps[i]);
        reference->follow(step);
        reference->findPairs(found);
        const auto isOver = [&](const TracePair& pair) {
            return present[pair.a] == 0 || present[pair.b] == 0 || !overlaps(boxes[pair.a], boxes[pair.b]);
        };
        const auto firstOver = std::stable_partition(alive.begin(), alive.end(), [&](auto& p) { return !isOver(p); });
        truth.ended.emplace_back(firstOver, alive.end());
        alive.erase(firstOver, alive.end());
        // A pair that both ended and began within the step is not new to anybody who keeps it in a set.
        alive.insert(alive.end(), found.begin(), found.end());
        truth.found.push_back(found.size());
        std::uint64_t hash = 0;
        for (const TracePair& pair : found) { hash += pairHash(pair); }
        truth.hashes.push_back(hash);
        if (i >= trace.warmSteps) {
            truth.meanAlive += static_cast<double>(alive.size());
            truth.meanFalse += static_cast<double>(countFalse(alive, bounds));
            timed += 1;
        }
    }
    if (timed > 0) {
        truth.meanAlive /= timed;
        truth.meanFalse /= timed;
    }
    return truth;
}

}  // namespace swept::bench
