#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "../../shapes/dvec2.h"
#include "../body_state.h"
#include "../direct/block33.h"

namespace swept::inline SWEPT_PRECISION {

/// A length without a root: of a vector, at most √2 times as large.
inline double norm(DVec2 v) { return std::fabs(v.x) + std::fabs(v.y); }

inline DVec2 leftOf(DVec2 v) { return {-v.y, v.x}; }

/// @param c,s  of the angle
inline DVec2 turned(double c, double s, DVec2 v) { return {c * v.x - s * v.y, s * v.x + c * v.y}; }

/// The larger one; what is no number is as bad as can be.
inline double worse(double a, double b) {
    if (b <= a) { return a; }
    return std::isnan(b) ? std::numeric_limits<double>::infinity() : b;
}

/// Gaps of this part of the arms are none.
inline constexpr double kNoGapRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 42);
/// Rounding may leave this part where masses are far apart.
inline constexpr double kLeftGapRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 34);

/// A body of an island, with its motion since the start of the step.
struct IslandBody {
    struct Place {
        DVec2 position;
        double angle = 0;
        double c = 1;
        double s = 0;
    };
    BodySlot slot = kFixedSlot;
    std::uint32_t column = 0;  ///< of the matrix; `kNoNode` where nothing can be moved
    double inverseMass = 0;
    double inverseInertia = 0;
    DVec2 gain;  ///< of half a sub-step
    double angularGain = 0;
    double decay = 1;  ///< likewise
    double angularDecay = 1;
    DVec2 velocity;
    double spin = 0;
    double given = 0;   ///< by the impulses of a stage, without signs, m/s: what is rounded
    double turned = 0;  ///< rad/s
    Place place;
    Place next;  ///< where the velocities lead
    /// Of a sub-step by its middle.
    struct Middle {
        DVec2 velocity;  ///< that it begins with
        double spin = 0;
        double c = 1;  ///< half way of the turn
        double s = 0;
        double chord = 1;      ///< of the turn, as a part of its arc
        double stiffness = 0;  ///< by which forces on the arms resist turning, kg·m²
    };
    Middle middle;
};

/// What of a row can be moved.
inline Block3 movable(const Block3& row, const IslandBody& body) {
    const double linear = body.inverseMass > 0 ? 1 : 0;
    return {linear * row[0], linear * row[1], body.inverseInertia > 0 ? row[2] : 0};
}

/// Radians that a body turns by when its anchor is moved by a metre, at most; 0 where it cannot turn, or be moved.
double easeOf(const IslandBody& body, DVec2 anchor);

/// What a joint holds rigidly, as one or two rows.
struct IslandHold {
    enum class Kind : std::uint8_t {
        point,  ///< two anchors coincide
        rod,    ///< their distance is `rest`
        side,   ///< B's anchor is on a line through A's, along `axis`, which turns with A
        angle,  ///< B's angle is A's, less `rest`
    };
    struct Row {
        Block3 ofA{};  ///< speed of the row per velocity of A: x, y, turn
        Block3 ofB{};
        Block3 endA{};  ///< likewise of the gap where a sub-step by its middle ends
        Block3 endB{};
        double strength = 0;  ///< of its damper; 0: nothing can move
        double excess = 0;    ///< speed that is to go
        double impulse = 0;   ///< of the present stage
        double force = 0;     ///< mean of the last sub-step
        double total = 0;     ///< impulse of the step
        double open = 0;      ///< gap that the step began with
        double pace = 0;      ///< speed that is to stay: that at which the length of a rod changes
    };
    Kind kind = Kind::point;
    std::uint8_t count = 1;
    std::uint32_t a = 0;  ///< bodies
    std::uint32_t b = 0;
    DVec2 anchorA;  ///< from the centres, at the start of the step
    DVec2 anchorB;
    DVec2 offset;  ///< of the centres
    DVec2 axis{1, 0};
    double rest = 0;   ///< goes with the pace
    double begun = 0;  ///< the same at the start of the step
    double size = 0;   ///< of what its error is measured against, metres or radians
    double rate = 0;   ///< 1/s at which errors are closed that cannot be closed at once
    Row rows[2];
    std::uint32_t firstDrive = 0;  ///< of the island
    std::uint32_t drives = 0;      ///< along what it leaves free, how many
    double tightness = 0;          ///< kg by which a rod under tension resists being moved aside, along the second row
    DVec2 reaction;                ///< on B, over the step, N·s
    double twist = 0;
};

/// A body of a tree, and what ties it to the one that is nearer to the ground. They are in the order from the ground,
/// or from one of the bodies, outwards.
struct IslandBranch {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::uint32_t body = 0;
    std::uint32_t parent = kNone;  ///< none where nothing ties it, or only the ground
    std::uint32_t holds[2] = {kNone, kNone};
    Block33 response{};  ///< speeds of its rows to their impulses, factorised
    Block3 lack{};       ///< speeds that are to be reached, then the impulses that reach them
};

}  // namespace swept::inline SWEPT_PRECISION
