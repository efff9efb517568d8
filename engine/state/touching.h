#pragma once

#include <cstdint>

namespace swept {

/// What is told about a contact with points, of a size that is copied at once.
struct TouchTraits {
    std::uint8_t points = 0;
    bool dynamicA : 1 = false;  ///< the body is
    bool dynamicB : 1 = false;
    bool bounces : 1 = false;         ///< has restitution
    bool isBelt : 1 = false;          ///< friction drags (`ShapeDef::surfaceSpeed`)
    bool resistsRolling : 1 = false;  ///< at one point (`ShapeDef::rollingResistance`)
    bool isOpen : 1 = false;          ///< its points are farther apart than those of touching shapes (`kEndRatio`)
    bool mayMeet : 1 = false;         ///< do not touch, and may come to that in this step
    bool isDeep : 1 = false;  ///< of what does not yield: overlaps too far to be swept out of it (`kShallowRatio`)

    bool areDynamic() const { return dynamicA && dynamicB; }
    bool rolls() const { return resistsRolling && points == 1; }
};

/// What a look at a contact with points finds that decides how its bodies are moved in this step.
struct TouchFindings {
    bool passes : 1 = false;    ///< its bodies pass each other: it has no points in this step
    bool mayHem : 1 = false;    ///< they pass each other so near that they may be held up (hemmed_pairs.h)
    bool bounces : 1 = false;   ///< of something static or kinematic: its body will bounce, or did and is on its way
    bool rests : 1 = false;     ///< likewise: it is carried, at least at one point
    bool strikes : 1 = false;   ///< likewise: a point gets there within this step, and not slowly, or round a curve
    bool isSunken : 1 = false;  ///< likewise: overlaps so far that it has to be held (`kSlackRatio`)
};

/// A contact with points, as far as roles and islands are about it: most of what they ask they then find here, in
/// order, instead of all over memory.
struct TouchingPair : TouchTraits {
    TouchingPair(const TouchTraits& traits, std::uint32_t place, std::uint32_t a, std::uint32_t b)
        : TouchTraits(traits), contact(place), bodyA(a), bodyB(b) {}

    /// One of them that is dynamic: if both are, A.
    std::uint32_t dynamicBody() const { return dynamicA ? bodyA : bodyB; }

    TouchFindings findings;  ///< of this step
    std::uint32_t contact;   ///< place in `WorldState::contacts`
    std::uint32_t bodyA;     ///< slots
    std::uint32_t bodyB;
};
static_assert(sizeof(TouchingPair) == 16, "a step makes thousands, and goes through them several times");

/// What becomes in this step of a pair of dynamic bodies that was never near (`WorldState::candidates`).
enum class CandidateFate : std::uint8_t { waits, goes, becomesContact };

/// What the contacts of a step ask of bodies, and tell about them: bits of one byte per body slot, so that those of all
/// bodies fit into the nearest cache. What others need of them `Body` has, too.
using BodyTraits = std::uint8_t;
inline constexpr BodyTraits kIsAwake = 1;
inline constexpr BodyTraits kIsFast = 2;
inline constexpr BodyTraits kHasContact = 4;
inline constexpr BodyTraits kTouchesDynamic = 8;
inline constexpr BodyTraits kIsDynamic = 16;  ///< and awake
inline constexpr BodyTraits kIsStill = 32;    ///< as far as its own motion tells (balance.h)
inline constexpr BodyTraits kIsFlyer = 64;    ///< the role that it was given
inline constexpr BodyTraits kIsTied = 128;    ///< likewise: `BodyRole::solved`

/// What is static never is.
constexpr bool isAwakeKinematic(BodyTraits traits) { return (traits & (kIsAwake | kIsDynamic)) == kIsAwake; }

}  // namespace swept
