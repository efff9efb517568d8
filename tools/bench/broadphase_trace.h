#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <swept/broadphase/broadphase.h>
#include <swept/engine/shape_def.h>

namespace swept::bench {

/// What a pair is filtered by. Proxies are numbered in the order in which they appear, and no number is used twice.
struct ProxyTraits {
    ProxyKind kind = ProxyKind::dynamic;
    std::uint32_t body = 0;  ///< proxies of one body do not pair
    Filter filter{};
    float extent = 1;  ///< smallest width of the shape, metres
    float reach = 1;   ///< half its largest width, metres
};

inline bool mayPair(const ProxyTraits& a, const ProxyTraits& b) {
    return a.body != b.body && canMeet(a.kind, b.kind) && shouldCollide(a.filter, b.filter);
}

struct ProxyBox {
    std::uint32_t proxy = 0;
    Aabb box;
};

/// Where one proxy is after a step: bounds without any margin, and the velocity of its centre in metres a step.
struct TightBox {
    std::uint32_t proxy = 0;
    Aabb box;
    Vec2 motion;
};

/// How things move, before anybody has enlarged a box. What is not listed in a step stays where it is.
struct MotionStep {
    std::vector<std::uint32_t> removed;
    std::vector<TightBox> placed;  ///< new proxies, ascending
    std::vector<TightBox> moved;   ///< of those that were there before
};

struct Motion {
    std::string name;
    std::vector<ProxyTraits> proxies;
    std::vector<MotionStep> steps;  ///< the first one places what is there at the start
};

/// How far boxes are enlarged, so that a small motion does not touch the broadphase.
struct MarginRule {
    float extentRatio = 0.125F;  ///< on every side, of the extent of the shape
    float stepsAhead = 0;        ///< and as many steps of its motion in the direction of the motion
    /// Instead: as Box2D 3 does, an eighth of the shape's reach, 5 cm at most; static shapes 2 cm.
    bool asBox2d3 = false;
};

/// What a broadphase is told in one step.
struct TraceStep {
    std::vector<std::uint32_t> removed;
    std::vector<ProxyBox> inserted;
    std::vector<ProxyBox> moved;
};

/// Enlarged boxes in the order in which a world hands them over.
struct BoxTrace {
    std::string name;
    std::vector<ProxyTraits> proxies;
    std::vector<TraceStep> steps;  ///< the first one inserts what is there at the start
    std::size_t warmSteps = 1;     ///< so many of them are not timed

    std::uint64_t timedMoves() const;  ///< boxes inserted and moved in the timed steps
};

/// Enlarges: a proxy's box is renewed in the step in which its bounds leave it.
BoxTrace enlarged(const Motion& motion, const MarginRule& rule);

struct TracePair {
    std::uint32_t a = 0;  ///< the smaller number
    std::uint32_t b = 0;
};

inline TracePair orderedPair(std::uint32_t a, std::uint32_t b) { return a < b ? TracePair{a, b} : TracePair{b, a}; }

/// A sum over pairs in any order: equal sets have equal sums, others hardly ever.
std::uint64_t pairHash(const TracePair& pair);

/// What the default implementation finds in a trace, against which others are compared.
struct TraceTruth {
    std::vector<std::vector<TracePair>> ended;  ///< per step: overlapped before, and do no more
    std::vector<std::uint64_t> found;           ///< per step: new pairs
    std::vector<std::uint64_t> hashes;
    double meanAlive = 0;  ///< pairs of overlapping boxes, mean over the timed steps
    double meanFalse = 0;  ///< of these, pairs whose bounds do not overlap
};

/// @param motion  what the trace was made of
TraceTruth truthOf(const Motion& motion, const BoxTrace& trace);

}  // namespace swept::bench
