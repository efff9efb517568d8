#pragma once

#include <algorithm>
#include <cmath>

#include "../../shapes/pair_view.h"
#include "../state/tolerances.h"
#include "../state/world_state.h"

/// Most contacts are of shapes whose boxes overlap and that are apart. Three things tell that without a look at either
/// shape: boxes that are no larger than the step needs, circles about the bodies, and how far apart the shapes were
/// when they were last looked at, against how far their bodies have moved since.

namespace swept::inline SWEPT_PRECISION {

/// Counts how far a body turned since it was last noted. After whatever moves a body.
void noteTravel(WorldState& world, std::uint32_t body);
/// The centre of mass became another point of the body, which did not move.
void noteNewCenter(WorldState& world, std::uint32_t body, DVec2 shift);
/// For a body that the next step finds asleep, or that is static: nothing is asked about it again before it moves.
void noteRest(WorldState& world, std::uint32_t body);
/// For a body that is awake, as the stage of contacts begins. @pre `BodyGlance::motion` is that of this step
void noteMotion(WorldState& world, std::uint32_t body);

/// Largest separation at which contact points of a shape are made: what it may move in a step, up to a part of its
/// extent (all of it in mode `speculative`).
Real contactReach(const WorldState& world, const Shape& shape);
/// Whether only mode `speculative` makes a contact between so distant shapes.
/// @pre the contact has points
bool isAhead(const WorldState& world, const Contact& contact);

/// Both bodies of a contact, as the stage of contacts found them.
struct BodyGlances {
    const BodyGlance& a;
    const BodyGlance& b;

    /// Whether they may pass each other: both are awake, and one of them is fast. @pre both are dynamic
    bool canPass() const {  // at once: which of them it is that is fast nothing foretells
        return ((int{a.isFast} | int{b.isFast}) & int{a.isAwake()} & int{b.isAwake()}) != 0;
    }
    /// Whether they are too far from each other for any contact point, whatever was rounded.
    bool areFar() const {
        const DVec2 offset = b.center - a.center;
        const double reach = static_cast<double>(a.reach) + static_cast<double>(b.reach);
        return dot(offset, offset) > reach * reach;
    }
    /// Whether the shapes of a contact without points are known to be so far from each other that they have none in
    /// this step either (`apart`), or only such as are dropped unless something stops the bodies, which pass each other
    /// (`passing`; `apart` where that is too far away to matter); else `near`. That is told from bounds, which depend
    /// on when and how the shapes were looked at last: so no result may follow from it but that what is `apart` has no
    /// points within the reach of a hem, and what is `passing` none unless it is hemmed in (hemmed_pairs.h).
    ContactState stateOfIdle(const ContactProbe& probe, Real dt) const;
    /// Of a pair that was looked at, and has no points unless it is hemmed in: whether it may be.
    /// @pre both are dynamic
    bool mayBeHemmed(const ContactProbe& probe) const;
    /// How far apart the shapes are, no less, as far as the probe and the motion since tell; metres, may be negative.
    double gapOf(const ContactProbe& probe) const { return probe.apartUntil - movedSince(probe); }
    /// Whether shapes that far apart have no contact points in this step.
    bool areBeyondReach(double gap) const { return static_cast<double>(a.ahead) + static_cast<double>(b.ahead) < gap; }
    /// @pre both are dynamic
    bool areBeyondHem(double gap) const { return static_cast<double>(kHemRatio * std::min(a.widest, b.widest)) < gap; }
    /// Fastest that they close in on each other along a world normal from A to B within the step, m/s.
    Real closingSpeed(Vec2 normal, Real dt) const {
        return (a.swing + b.swing) - dot(b.velocity - a.velocity, normal) + dt * length(b.pull - a.pull);
    }
    /// How far the bodies have moved, compared with `ContactProbe::apartUntil`: metres.
    double movedSince(const ContactProbe& probe) const;
    /// Dynamic bodies that are awake, one of them fast, pass each other where their shapes are farther apart than this,
    /// metres: whatever points they would have are dropped by `passEachOther` (note_touching.cpp), which looks along
    /// the normal. Others never pass: infinite.
    /// @pre both are dynamic
    Real passesBeyond(Real dt) const;
};

/// Writes down in the probe how long the shapes of a contact stay so far apart that it has no points. Certain whatever
/// was rounded: without it no contact point is another.
/// @param room  how far apart they are, no more, metres
void rememberApart(const WorldState& world, ContactProbe& probe, Real room);

/// Never shorter than the vector, and at most a twelfth longer: without squares, which overflow, and without a root.
inline double lengthAtMost(DVec2 v) {
    constexpr double kDiagonal = 0.41421357;  // a little above √2 − 1
    const double x = std::fabs(v.x);
    const double y = std::fabs(v.y);
    // The larger one has the longer side whole. Which that is, is as good as random: a maximum is no branch.
    const double ofX = x + kDiagonal * y;
    const double ofY = y + kDiagonal * x;
    return ofX > ofY ? ofX : ofY;
}

inline double BodyGlances::movedSince(const ContactProbe& probe) const {
    return lengthAtMost((b.center - a.center) - toDouble(probe.offset)) + (a.turned + b.turned);
}

inline ContactState BodyGlances::stateOfIdle(const ContactProbe& probe, Real dt) const {
    const double gap = gapOf(probe);
    if (areBeyondReach(gap)) { return ContactState::apart; }
    if (!(probe.isPlain && static_cast<double>(passesBeyond(dt)) < gap)) { return ContactState::near; }
    return areBeyondHem(gap) ? ContactState::apart : ContactState::passing;
}

inline bool BodyGlances::mayBeHemmed(const ContactProbe& probe) const {
    if (!canPass()) { return false; }
    const double gap = gapOf(probe);
    return !areBeyondReach(gap) && !areBeyondHem(gap);
}

inline Real BodyGlances::passesBeyond(Real dt) const {
    constexpr Real kAllRoundings = 1 + 32 * kEpsilon;
    if (!canPass()) { return std::numeric_limits<Real>::infinity(); }
    const Real closing = (a.swing + b.swing) + length(b.velocity - a.velocity) + dt * length(b.pull - a.pull);
    // What is no farther apart than touching shapes may be does not pass.
    const Real least = kEndRatio * std::min(a.widest, b.widest);
    return kAllRoundings * std::max(closing * dt, least);
}

}  // namespace swept::inline SWEPT_PRECISION
