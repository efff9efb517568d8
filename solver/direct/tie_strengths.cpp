#include "tie_strengths.h"

#include <algorithm>

#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Where joints hold angles, in units of all that they tie together, for each of its bodies: dampers of a row of joints
/// add up what they give. (At strengths below all of it a cantilever of twenty welded bars swung by itself as soon as
/// something lay on it, and its weld at the wall told up to 80 times the torque that it carries. At 1 to 2.5 times all
/// of it, as thirty bars had with sixteen times their strength and 120 with a thousand times, they still swung, at 20
/// times they stood.) In units of its own mass at most: enough digits are left for a body of its own.
constexpr double kTieStrength = 2;
constexpr double kMostStrength = static_cast<double>(std::uint64_t{1} << 40);

}  // namespace

bool TieStrengths::noteAngles(const SolverBatch& batch, const DirectSystem& system) {
    holdsAngles_.assign(system.nodes().size(), 0);
    bool isAny = false;
    const auto note = [&](const JointConstraint& joint) {
        for (const BodySlot slot : {joint.slotA, joint.slotB}) {
            const std::uint32_t node = system.nodeOf(slot);
            if (node == kNoNode) { continue; }
            holdsAngles_[system.islandOf(node)] = 1;
            isAny = true;
        }
    };
    for (const WeldConstraint& joint : batch.welds) {
        if (!joint.hasAngularSpring) { note(joint); }
    }
    for (const PrismaticConstraint& joint : batch.prismatics) { note(joint); }
    return isAny;
}

void TieStrengths::find(const SolverBatch& batch, const DirectSystem& system, bool holdsDrives) {
    isAny_ = noteAngles(batch, system);
    if (!isAny_) { return; }
    members_.clear();
    for (const DirectSystem::Node& node : system.nodes()) { members_.push_back({node.mass, node.inertia}); }
    links_.clear();
    const auto link = [&](const auto& joints) {
        for (const JointConstraint& joint : joints) {
            const std::uint32_t a = system.nodeOf(joint.slotA);
            const std::uint32_t b = system.nodeOf(joint.slotB);
            if (a == kNoNode || b == kNoNode || a == b) { continue; }
            const Vec2 moved = batch.states[joint.slotB].deltaPosition - batch.states[joint.slotA].deltaPosition;
            links_.push_back({a, b, toDouble(joint.centerOffset + moved)});
        }
    };
    forEachHeldKind(batch, link);
    if (holdsDrives) { link(batch.motors); }
    weights_.find(members_, links_);
}

void TieStrengths::stiffen(const DirectSystem& system, std::span<const BodyInertia> inertias, const DirectRow& held,
                           SystemRow& row) const {
    const std::uint32_t node = row.nodeA != kNoNode ? row.nodeA : row.nodeB;
    if (!isAny_ || node == kNoNode || !(row.strength > 0)) { return; }
    const std::uint32_t island = system.islandOf(node);
    if (holdsAngles_[island] == 0) { return; }
    double answer = 0;
    if (row.nodeA != kNoNode) { answer += answerOf(inertias[held.slotA], row.ofA); }
    if (row.nodeB != kNoNode) { answer += answerOf(inertias[held.slotB], row.ofB); }
    const DirectSystem::Load& load = system.loadOf(island);
    double carried = load.mass;
    if (held.row.linear == Vec2{}) {
        carried = weights_.inertiaAbout(node);
        if (row.nodeB != kNoNode) { carried = std::max(carried, weights_.inertiaAbout(row.nodeB)); }
    }
    const double wanted = kTieStrength * load.bodies * carried;
    row.strength = std::max(row.strength, std::min(wanted, kMostStrength / answer));
}

}  // namespace swept::inline SWEPT_PRECISION
