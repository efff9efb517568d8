#pragma once

#include "joint_builder.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// The hinges of a group that is solved, most of all joints: laid from the joints into the blocks of the kernels, and
/// their impulses back. As constraints of the batch they were copied five times a step, which took twice as long as to
/// solve them.
class TiedHinges final : public HingeStore {
public:
    /// @param h  seconds of a sub-step
    /// @pre the bodies of the group have their slots. Holds on to the world and the desk
    TiedHinges(WorldState& world, const TiedGroup& group, Real h, const StepPart& part);

    /// Gives the batch the link of a hinge, which it takes from here when it is solved.
    void link(std::uint32_t joint, const JointTie& tie);

    void fill(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& to) override;
    void take(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& from) override;

private:
    Vec2 armOf(BodySlot slot, std::uint32_t body, Vec2 localAnchor) const;
    void fetchAhead(std::size_t i) const;
    void fillLane(WideRevolute& block, std::size_t lane, const HingeLink& link) const;

    WorldState& world_;
    SolveDesk& desk_;
    SolveTimes times_;
    Softness softness_;
    bool mayAnyTear_;
};

}  // namespace swept::inline SWEPT_PRECISION
