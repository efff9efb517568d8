#include "tied_hinges.h"

#include "../../shapes/cache_line.h"
#include "../../solver/joint_blocks/hinge_lanes.h"
#include "joint_rest.h"
#include "joint_results.h"
#include "rest_springs.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Hinges that are fetched from memory ahead of time: joints are large, and a step asks one or two cache lines of each.
constexpr std::size_t kHingesAhead = 8;

void fetch(const Joint& joint) {
    prefetch(&joint);
    prefetch(&joint.hinge.motor);
}

HingeMemory impulsesOf(const WideRevolute& block, std::size_t lane) {
    HingeMemory memory{.point = {block.impulseX[lane], block.impulseY[lane]}};
    if (block.parts.any()) {
        memory.lower = block.lowerImpulse[lane];
        memory.upper = block.upperImpulse[lane];
        memory.motor = block.motorImpulse[lane];
        memory.spring = block.springImpulse[lane];
    }
    return memory;
}

}  // namespace

TiedHinges::TiedHinges(WorldState& world, const TiedGroup& group, Real h, const StepPart& part)
    : world_(world),
      desk_(group.desk),
      times_(part, h),
      softness_(jointSoftness(world, group.effort, h, times_.dt)),
      mayAnyTear_(mayAnyTear(world)) {}

void TiedHinges::link(std::uint32_t joint, const JointTie& tie) {
    SolverBatch& batch = desk_.batch;
    batch.hingeLinks.push_back({.slotA = world_.solverSlots[tie.bodyA],
                                .slotB = world_.solverSlots[tie.bodyB],
                                .source = joint,
                                .parts = tie.hingeParts});
    batch.hingeStore = this;
}

/// Of the bodies of a solve centres stand in an array of their own.
Vec2 TiedHinges::armOf(BodySlot slot, std::uint32_t body, Vec2 localAnchor) const {
    const Vec2 localCenter = slot != kFixedSlot ? desk_.localCenters[slot] : world_.bodies[body].localCenter;
    return rotate(world_.motions[body].pose.rotation, localAnchor - localCenter);
}

/// What `addConstraint` puts into a constraint.
void TiedHinges::fillLane(WideRevolute& block, std::size_t lane, const HingeLink& link) const {
    const Joint& joint = world_.joints[link.source];
    const SolverBatch& batch = desk_.batch;
    HingeHead head{.slotA = link.slotA,
                   .slotB = link.slotB,
                   .anchorA = armOf(link.slotA, joint.bodyA, joint.localAnchorA),
                   .anchorB = armOf(link.slotB, joint.bodyB, joint.localAnchorB),
                   .centerOffset = toReal(world_.motions[joint.bodyB].center - world_.motions[joint.bodyA].center),
                   .softness = softness_,
                   .impulse = joint.hinge.point};
    if (mayAnyTear_ && mayTear(world_, joint)) {
        const Real gap = length(head.centerOffset + head.anchorB - head.anchorA);
        head.softness = easedOf(softness_, world_, joint,
                                {gap, link.parts.hasLimits ? limitErrorsOf(world_, joint).angle : Real(0)});
    }
    if (world_.anyRestLoads && joint.restLoad.any()) {
        BodyState still;
        head.centerOffset +=
            restGap({still, still, batch.inertias[link.slotA], batch.inertias[link.slotB]}, head.anchorA, head.anchorB,
                    link.parts.any(), head.softness, times_.h * joint.restLoad.force);
    }
    fillHead(block, lane, head, batch.inertias[link.slotA], batch.inertias[link.slotB]);
    if (!block.parts.any()) { return; }
    const RevoluteJointDef& def = std::get_if<HingePart>(&joint.parts)->def;
    const Real angle = static_cast<Real>(angleOf(world_, joint)) - springTargetOf(def);
    fillParts(block, lane, hingeParts(joint, angle, times_), angle);
}

void TiedHinges::fetchAhead(std::size_t i) const {
    const std::vector<HingeLink>& links = desk_.batch.hingeLinks;
    if (i + kHingesAhead < links.size()) { fetch(world_.joints[links[i + kHingesAhead].source]); }
}

void TiedHinges::fill(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& to) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const BlockPlace& place = places[i];
        const HingeLink& link = desk_.batch.hingeLinks[first + i];
        fetchAhead(first + i);
        if (place.isInBlock) {
            fillLane(to.blocks[place.index], place.lane, link);
        } else {
            RevoluteConstraint& hinge = to.rest[place.index];
            hinge = hingeConstraint(world_, link.source, times_);
            if (world_.anyRestLoads) { bear(hinge, world_, world_.joints[link.source], times_.h); }
        }
    }
}

void TiedHinges::take(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& from) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const BlockPlace& place = places[i];
        fetchAhead(first + i);
        Joint& joint = world_.joints[desk_.batch.hingeLinks[first + i].source];
        if (!place.isInBlock) {
            takeHinge(joint, from.rest[place.index], times_.length);
            continue;
        }
        const WideRevolute& block = from.blocks[place.index];
        joint.hinge = impulsesOf(block, place.lane);
        takeReaction(joint, totalOf(block, place.lane), times_.length);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
