#pragma once

#include "../../solver/contacts/contact_rows.h"
#include "constraint_builder.h"
#include "tied_group.h"
#include "tied_hits.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of a group that is solved: made constraints of, and given their impulses back.
class TiedContacts final : public ContactStore {
public:
    /// Holds on to the world and the group.
    /// @param h  seconds of a sub-step. In one shorter than the world's, overlap is pushed out no faster than in that:
    /// what the relaxation leaves of the push would be energy.
    /// @param scale  of the impulses that are kept, which are those of the world's sub-steps
    TiedContacts(WorldState& world, const TiedGroup& group, const StepPart& part, Real h, Real scale);

    /// Gives the batch links to contacts that it takes from here when it is solved.
    /// @pre the bodies of the group have their slots
    /// @return how many have restitution: if there are any, it has to be said next how they bounce
    std::size_t link();
    /// @param inTurn  as `SolverSettings::bouncesInTurn`; else together, each a constraint on its own. @pre linked
    void letBounce(bool inTurn);
    /// Takes the links back.
    void unlink();
    /// Makes constraints of them at once. @pre the bodies of the group are set, and there are no links
    void addConstraints();
    /// How many have restitution. @pre the bodies of the group have their slots
    std::size_t countBouncing() const;
    /// What has more to be said about it than a link can tell has its constraint in the batch.
    void readConstraints();
    std::size_t count() const;

    void fill(std::span<WideContact<1>> blocks, Links links) override;
    void fill(std::span<WideContact<2>> blocks, Links links) override;
    void fill(std::span<ContactConstraint> alone, Links links) override;
    void take(std::span<const WideContact<1>> blocks, Links links) override;
    void take(std::span<const WideContact<2>> blocks, Links links) override;
    void take(std::span<const ContactConstraint> alone, Links links) override;

private:
    bool linkIfTied(ContactLink& link, std::uint32_t source, std::uint32_t bodyA, std::uint32_t bodyB,
                    const TouchTraits& traits) const;
    template <class Visit>
    void forEachLink(const Visit& visit) const;
    LinkCounts linkSome(std::span<const TouchingPair> pairs, ContactLink* to) const;
    ContactFrame frameOf(const Contact& contact, const ContactLink& link) const;
    ContactConstraint constraintFor(const ContactLink& link);
    template <std::size_t kPoints>
    void fillBlocks(std::span<WideContact<kPoints>> blocks, Links links);
    template <std::size_t kPoints>
    void setLane(WideContact<kPoints>& block, std::size_t lane, const ContactLink& link, ContactSources& from) const;
    template <std::size_t kPoints>
    void takeBlocks(std::span<const WideContact<kPoints>> blocks, Links links);
    template <std::size_t kPoints>
    void noteHits(const WideContact<kPoints>& block, Links links, const LanesByPoint& struck, std::uint32_t began);
    void takeConstraint(const ContactConstraint& constraint);
    void noteHit(const Contact& contact, const ContactConstraint& constraint, const LanesByPoint& struck, bool began);
    void anchorAhead();
    Softness softnessOf(const ContactLink& link) const;
    template <std::size_t kPoints>
    void softenStrained(WideContact<kPoints>& block, Links links) const;
    Real bounceSpeedOf(const Contact& contact) const;

    WorldState& world_;
    const TiedGroup& group_;
    TiedHits hits_;
    Real scale_;
    Real dt_;
    Real closingTime_;                                          ///< s, that or more: within it overlaps are pushed out
    Real bounceSpeed_ = std::numeric_limits<Real>::infinity();  ///< of links with restitution, m/s
    Softness softness_;
    Softness groundSoftness_;
};

}  // namespace swept::inline SWEPT_PRECISION
