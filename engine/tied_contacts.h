#pragma once

#include "constraint_builder.h"
#include "short_lock.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of a group that is solved: made constraints of, and given their impulses back.
class TiedContacts final : public ContactStore {
public:
    /// @param h  seconds of a sub-step. In one shorter than the world's, overlap is pushed out no faster than in that:
    /// what the relaxation leaves of the push would be energy.
    /// @param scale  of the impulses that are kept, which are those of the world's sub-steps
    /// @pre the bodies of the group have their slots. Holds on to the world and the group
    TiedContacts(WorldState& world, const TiedGroup& group, const StepPart& part, Real h, Real scale);

    /// Gives the batch links to contacts that it takes from here when it is solved; or makes constraints of them at
    /// once.
    /// @param inTurn  whether those with restitution bounce in turn (`SolverSettings::bouncesInTurn`); else together,
    /// each a constraint on its own
    void link(bool inTurn);
    void addConstraints();
    /// How many have restitution.
    std::size_t countBouncing() const;
    /// What has more to be said about it than a link can tell has its constraint in the batch.
    void readConstraints();
    std::size_t count() const;

    void fill(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& to) override;
    void take(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& from) override;
    void end() override;

private:
    /// What a solve found out about a contact.
    struct Outcome {
        Vec2 normal{};
        std::array<Real, 2> normalImpulse{};
        std::array<Real, 2> tangentImpulse{};
        std::array<Real, 2> totalImpulse{};
        Real bounceApproach = 0;
    };

    template <class Visit>
    void forEachLink(Visit&& visit) const;
    ContactConstraint constraintFor(const ContactLink& link);
    template <std::size_t kPoints>
    void fillContact(WideContact<kPoints>& block, std::size_t lane, const ContactLink& link);
    template <std::size_t kPoints>
    void takeContact(const WideContact<kPoints>& block, std::size_t lane, Contact& contact);
    void takeConstraint(const ContactConstraint& constraint);
    void takeOutcome(Contact& contact, std::size_t points, const Outcome& outcome);
    void noteHit(const Contact& contact, const Outcome& outcome);
    void anchorAhead();
    Real bounceSpeedOf(const Contact& contact) const;

    WorldState& world_;
    const TiedGroup& group_;
    const StepPart& part_;
    ShortLock hitting_;  ///< held by who adds to `SolveDesk::hits`
    Real scale_;
    Real dt_;
    Real hitThreshold_;                                         ///< approach speed of what only rests, m/s
    Real bounceSpeed_ = std::numeric_limits<Real>::infinity();  ///< of links with restitution, m/s
    Softness softness_;
};

}  // namespace swept::inline SWEPT_PRECISION
