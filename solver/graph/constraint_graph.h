#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "../solver_batch.h"
#include "constraint_colours.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts of a colour with as many points in blocks.
struct ContactCount {
    std::array<std::uint32_t, 2> ofSide{};  ///< that are counted from the front, and from the back (`ContactRank`)

    std::uint32_t front() const { return ofSide[0]; }
    std::uint32_t all() const { return ofSide[0] + ofSide[1]; }
    bool operator==(const ContactCount&) const = default;
};
/// By colour: of contacts with no point in blocks, one and two. In the overflow none has any.
using PointCounts = std::array<std::array<ContactCount, 3>, kColourCount>;

/// Where a contact stands among those of its colour with as many points in blocks, in their order: from the front if it
/// is about the first half of the bodies, or has no points there, else from the back.
struct ContactRank {
    static constexpr int kSideBit = 31;
    static constexpr std::uint32_t kIsBack = std::uint32_t{1} << kSideBit;
    std::uint32_t value = 0;

    bool isBack() const { return value >= kIsBack; }
    std::uint32_t number() const { return value & ~kIsBack; }
    bool operator==(const ContactRank&) const = default;
};

/// Greedy colouring in array order (deterministic), then a stable sort by colour: of the joints themselves, kind by
/// kind, and of the places of the contacts. Colours of links follow from the links of the batch alone, and are kept as
/// long as these, and who can be moved, are the same as the time before: of hinges nearly always.
class ConstraintGraph {
public:
    void colour(SolverBatch& batch);
    /// The same of a batch without joints, of which nothing must be asked then.
    void colourContacts(const SolverBatch& batch);
    /// The same as one of these before the bodies of the batch are set. @param standing  those that cannot be moved,
    /// besides the fixed world
    void colourAhead(SolverBatch& batch, bool onlyContacts, std::span<const BodySlot> standing = {});
    /// Sorts the contacts, too. @pre just coloured
    void sortContacts(SolverBatch& batch);

    /// Colours in use, ascending.
    const std::vector<int>& activeColours() const { return active_; }
    /// Places of contacts in the batch, colour by colour. Not of links.
    std::span<const std::uint32_t> contacts() const { return places_; }
    /// By contact, or link.
    std::span<const std::uint8_t> contactColours() const { return colours_; }
    const PointCounts& pointCounts() const { return pointCounts_; }
    /// By contact, or link.
    std::span<const ContactRank> contactRanks() const { return ranks_; }
    /// By link of a hinge.
    std::span<const std::uint8_t> hingeColours() const { return hingeColours_; }
    /// Whether links of hinges, and their colours, are those of the time before.
    bool areHingesKept() const { return areHingesKept_; }
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

    /// What links had the last time. Only of as many links as the time before that are they written down: where
    /// contacts come and go in every step it would be for nothing.
    struct Before {
        RawVector<std::uint64_t> fixed;  ///< per slot: `kIsFixed`, or nothing
        std::vector<HingeLink> hinges;
        RawVector<std::uint64_t> usedByHinges;
        std::uint64_t isUsedByHinges = 0;
        bool hasOthers = false;  ///< joints that have no links
        RawVector<ContactLink> contacts;
        std::size_t contactCount = 0;
        std::uint64_t isUsed = 0;
    };

    void begin(const SolverBatch& batch);
    void noteFixed();
    void finish(const SolverBatch& batch);
    void colourHinges(const std::vector<HingeLink>& links);
    void colourJoints(SolverBatch& batch);
    void colourContactLinks(const RawVector<ContactLink>& links);
    template <class Constraint>
    ColourRanges& rangesOf() {
        return std::get<Kind<Constraint>>(kinds_).ranges;
    }
    template <std::size_t kBodies>
    int colourFor(const std::array<BodySlot, kBodies>& slots);
    template <class Constraint>
    void listByColour(const std::vector<Constraint>& constraints, ColourRanges& ranges);
    void colourLinks(const RawVector<ContactLink>& links);
    void forgetCounts();
    template <class Contact>
    void rank(const Contact& contact, std::size_t i);
    template <class Constraint>
    void sortAsListed(std::vector<Constraint>& constraints);

    RawVector<std::uint64_t> used_;    ///< per slot: colours taken, one bit each; or that it cannot be moved
    RawVector<std::uint8_t> colours_;  ///< of the kind that was coloured last: contacts, in the end
    RawVector<std::uint32_t> places_;  ///< likewise
    RawVector<std::uint8_t> hingeColours_;
    Before before_;
    bool areBodiesKept_ = false;
    bool areHingesKept_ = false;
    bool hasOthers_ = false;  ///< joints that have no links
    PointCounts pointCounts_{};
    RawVector<ContactRank> ranks_;
    std::uint64_t isUsed_ = 0;  ///< one bit per colour
    std::vector<int> active_;
    std::tuple<Kind<ContactConstraint>, Kind<RevoluteConstraint>, Kind<DistanceConstraint>, Kind<PrismaticConstraint>,
               Kind<WheelConstraint>, Kind<WeldConstraint>, Kind<MotorConstraint>, Kind<MouseConstraint>,
               Kind<GearConstraint>, Kind<PulleyConstraint>>
        kinds_;
};

}  // namespace swept::inline SWEPT_PRECISION
