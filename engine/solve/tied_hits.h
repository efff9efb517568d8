#pragma once

#include <array>
#include <vector>

#include "../../solver/contacts/contact_constraint.h"
#include "../crew/short_lock.h"
#include "../state/step_part.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The two bodies of a contact as a solve found them. What it does not move stands.
struct TiedPair {
    BodyState a;
    BodyState b;

    /// How fast a point comes along the normal, m/s; less than 0: it goes.
    Real approachAt(const ContactConstraintPoint& point, Vec2 normal) const;
};

/// Which contacts of a solve were blows, and tells them (`ContactEventType::hit`). What rests presses on and on, so
/// only points that begin to press are judged: by their approach before the solve, or by that with which they bounced
/// in it. Several workers may note hits at the same time, as long as nobody has moved the bodies of the world.
class TiedHits {
public:
    /// Holds on to all of them.
    TiedHits(const WorldState& world, const StepPart& part, std::vector<ContactEvent>& events);

    /// Approach speed of what only rests, m/s.
    Real threshold() const { return threshold_; }
    TiedPair pairOf(const Contact& contact, BodySlot slotA, BodySlot slotB) const;
    /// @param speeds  of approach, by point, m/s; 0: it did not begin to press
    /// @param began   whether the contact did not press before at all
    /// @pre the contact has its totals
    void note(const Contact& contact, Vec2 normal, const std::array<Real, 2>& speeds, bool began);

private:
    Real leastAgain(const Contact& contact) const;
    Vec2 gainOf(std::uint32_t body) const;

    const WorldState& world_;
    const StepPart& part_;
    std::vector<ContactEvent>& events_;
    ShortLock hitting_;  ///< held by who adds to `events_`
    Real dt_;
    Real threshold_;
};

}  // namespace swept::inline SWEPT_PRECISION
