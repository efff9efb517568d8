#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "solver_batch.h"

namespace swept::inline SWEPT_PRECISION {

/// Colours of the constraint graph. Two constraints of one colour share no movable body, so a colour can be solved wide
/// or by many threads, in any order, with the same bits. The last colour is the overflow: solved one after the other.
inline constexpr int kColourCount = 64;
inline constexpr int kOverflowColour = kColourCount - 1;
/// Constraints against the fixed world take colours from here on, so that they are solved last: ground has the last
/// word.
inline constexpr int kFirstFixedColour = 48;

/// By colour: how many contacts there are with no point, one and two.
using PointCounts = std::array<std::array<std::uint32_t, 3>, kColourCount>;

/// A range of one colour within a kind's array.
struct ColourRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Greedy colouring in array order (deterministic), then a stable sort by colour: of the joints themselves, kind by
/// kind, and of the places of the contacts.
class ConstraintGraph {
public:
    void colour(SolverBatch& batch);
    /// The same of a batch without joints, of which nothing must be asked then.
    void colourContacts(const SolverBatch& batch);
    /// The same before the bodies of the batch are set: all can be moved but the fixed world.
    void colourAhead(const SolverBatch& batch);
    /// Sorts the contacts, too. @pre just coloured
    void sortContacts(SolverBatch& batch);

    /// Colours in use, ascending.
    const std::vector<int>& activeColours() const { return active_; }
    /// Places of contacts in the batch, colour by colour. Not of links.
    std::span<const std::uint32_t> contacts() const { return places_; }
    /// By contact, or link.
    std::span<const std::uint8_t> contactColours() const { return colours_; }
    const PointCounts& pointCounts() const { return pointCounts_; }
    /// By link of a hinge.
    std::span<const std::uint8_t> hingeColours() const { return hingeColours_; }
    /// Where a colour's constraints of a kind stand in the array of that kind; of contacts: among `contacts`.
    template <class Constraint>
    ColourRange range(int colour) const {
        return std::get<Kind<Constraint>>(kinds_).ranges[static_cast<std::size_t>(colour)];
    }

private:
    using ColourRanges = std::array<ColourRange, kColourCount>;
    template <class Constraint>
    struct Kind {
        ColourRanges ranges{};
        std::vector<Constraint> scratch;
    };

    void begin(const SolverBatch& batch);
    void finish(const SolverBatch& batch);
    template <class Constraint>
    ColourRanges& rangesOf() {
        return std::get<Kind<Constraint>>(kinds_).ranges;
    }
    template <std::size_t kBodies>
    int colourFor(const std::array<BodySlot, kBodies>& slots);
    template <class Constraint>
    void listByColour(const std::vector<Constraint>& constraints, ColourRanges& ranges);
    void colourLinks(const std::vector<ContactLink>& links);
    void countPoints(const std::vector<ContactConstraint>& contacts);
    template <class Constraint>
    void sortAsListed(std::vector<Constraint>& constraints);

    RawVector<std::uint64_t> used_;    ///< per slot: colours taken, one bit each; or that it cannot be moved
    RawVector<std::uint8_t> colours_;  ///< of the kind that was coloured last: contacts, in the end
    RawVector<std::uint32_t> places_;  ///< likewise
    RawVector<std::uint8_t> hingeColours_;
    PointCounts pointCounts_{};
    std::uint64_t isUsed_ = 0;  ///< one bit per colour
    std::vector<int> active_;
    std::tuple<Kind<ContactConstraint>, Kind<RevoluteConstraint>, Kind<DistanceConstraint>, Kind<PrismaticConstraint>,
               Kind<WheelConstraint>, Kind<WeldConstraint>, Kind<MotorConstraint>, Kind<MouseConstraint>,
               Kind<GearConstraint>, Kind<PulleyConstraint>>
        kinds_;
};

}  // namespace swept::inline SWEPT_PRECISION
