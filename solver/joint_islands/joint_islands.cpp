#include "joint_islands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include "../../shapes/vec2.h"
#include "../direct/direct_parts.h"
#include "../direct/direct_rows.h"
#include "island_drives.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint32_t kNoPart = ~std::uint32_t{0};
/// Islands per part of a parallel loop.
constexpr std::size_t kIslandGrain = 1;
/// Rows that give way in loops end up working against each other with 10³ to 10⁶ times the momentum that all has at its
/// speed, and that of a step's fall; a taut bridge pulls with some times that.
constexpr double kMostOfMomentum = 64;

IslandBody bodyAt(const SolverBatch& batch, BodySlot slot) {
    const BodyState& state = batch.states[slot];
    const BodyInertia& inertia = batch.inertias[slot];
    IslandBody body;
    body.slot = slot;
    body.inverseMass = static_cast<double>(inertia.inverseMass);
    body.inverseInertia = static_cast<double>(inertia.inverseInertia);
    body.velocity = toDouble(state.velocity);
    body.spin = static_cast<double>(state.angularVelocity);
    const BodyDrive& drive = batch.drives[slot];
    body.gain = toDouble(drive.gain);
    body.angularGain = static_cast<double>(drive.angularGain);
    body.decay = static_cast<double>(drive.decay);
    body.angularDecay = static_cast<double>(drive.angularDecay);
    return body;
}

/// Rows that give way in a loop.
struct VoidBounds {
    double impulse = 0;  ///< N·s, beyond which they mean nothing
    double twist = 0;    ///< N·m·s, likewise
    bool areExceededBy(const IslandHold& hold) const {
        const double most = hold.kind == IslandHold::Kind::angle ? twist : impulse;
        return std::any_of(std::begin(hold.rows), std::end(hold.rows),
                           [most](const IslandHold::Row& row) { return std::fabs(row.total) > most; });
    }
};

/// Impulses by the momentum of all, what resists turning by that at the longest arm: of an anchor, or with which a body
/// resists turning itself. Drives of the step are those of the batch, for half a sub-step: the island may have made
/// more of its own.
VoidBounds voidBoundsOf(JointIsland& island, const SolverBatch& batch, int subSteps) {
    double mass = 0;
    double speed = 0;
    double fall = 0;
    double arm = 0;
    for (const IslandBody& body : island.bodies()) {
        if (body.column == kNoNode) { continue; }
        const double own = body.inverseInertia > 0 ? std::sqrt(body.inverseMass / body.inverseInertia) : 0;
        mass += 1 / body.inverseMass;
        speed = std::max({speed, length(body.velocity), own * std::fabs(body.spin)});
        fall = std::max(fall, 2 * subSteps * length(toDouble(batch.drives[body.slot].gain)));
        arm = std::max(arm, own);
    }
    for (const IslandHold& hold : island.holds()) {
        if (island.bodies()[hold.a].column != kNoNode) { arm = std::max(arm, length(hold.anchorA)); }
        if (island.bodies()[hold.b].column != kNoNode) { arm = std::max(arm, length(hold.anchorB)); }
    }
    const double most = kMostOfMomentum * mass * (speed + fall);
    return {.impulse = most, .twist = most * arm};
}

/// Nobody begins with the impulses of what gave way where they mean nothing. (A net of 64 discs that balls had opened
/// by 3 cm ended the step in which it closed with 2e7 N·s in its hinges, where it weighs 74. The next step was
/// iterated, since a ball touched it again, and opened them by 1.9 m, with nearly twice the energy.)
void forgetVoidForces(JointIsland& island, const SolverBatch& batch, int subSteps) {
    if (!island.isSoft() || island.isTree()) { return; }
    const VoidBounds bounds = voidBoundsOf(island, batch, subSteps);
    const std::vector<IslandHold>& holds = island.holds();
    if (std::none_of(holds.begin(), holds.end(),
                     [&bounds](const IslandHold& hold) { return bounds.areExceededBy(hold); })) {
        return;
    }
    for (IslandHold& hold : island.holds()) {
        for (IslandHold::Row& row : hold.rows) { row.total = 0; }
    }
}

}  // namespace

/// Adds what joints hold, one after another.
class HoldWriter {
public:
    HoldWriter(JointIslands& islands, SolverBatch& batch, Real h, int subSteps)
        : islands_(islands),
          batch_(batch),
          h_(h),
          step_{.h = static_cast<double>(h), .duration = static_cast<double>(h) * subSteps} {}

    void operator()(RevoluteConstraint& joint) {
        addPoint(joint, joint.linearImpulse);
        addDrives(drivesOf(batch_, joint, step_), drivenBy(joint, joint.motorImpulse));
    }
    void operator()(DistanceConstraint& joint) {
        IslandHold& hold = add(joint, IslandHold::Kind::rod, joint.rigidImpulse);
        hold.axis = toDouble(joint.axis);
        hold.rest = hold.begun = static_cast<double>(joint.length);
        if (!joint.isGliding) { return; }
        // What it goes farther than by its pace is a gap, which is closed over all of the step.
        const auto pace = static_cast<double>(joint.motion.pace.lower);
        hold.rest += (static_cast<double>(joint.motion.glide.lower) - pace) * step_.duration;
        hold.begun = hold.rest;
        hold.rows[0].pace = pace;
        islands_.parts_[islands_.sources_.back().part].allowPace();
    }
    void operator()(PrismaticConstraint& joint) {
        addSide(joint, joint.heldImpulse.x);
        addDrives(drivesOf(batch_, joint, step_), drivenBy(joint, joint.motorImpulse));
        addAngle(joint, joint.heldImpulse.y);
    }
    void operator()(WheelConstraint& joint) {
        addSide(joint, joint.heldImpulse.x);
        addDrives(drivesOf(batch_, joint, step_), drivenBy(joint.suspension, joint.motorImpulse));
    }
    void operator()(WeldConstraint& joint) {
        addPoint(joint, joint.linearImpulse);
        if (joint.hasAngularSpring) {
            addDrives(drivesOf(batch_, joint, step_), {.springImpulse = &joint.angularImpulse});
        } else {
            addAngle(joint, joint.angularImpulse);
        }
    }

private:
    IslandHold& add(JointConstraint& joint, IslandHold::Kind kind, Real& impulse) {
        const bool movesA = isMovable(batch_.inertias[joint.slotA]);
        const std::uint32_t number = islands_.partOf_[movesA ? joint.slotA : joint.slotB];
        JointIsland& island = islands_.parts_[number];
        IslandHold hold;
        hold.kind = kind;
        hold.a = islands_.bodyOf(batch_, number, joint.slotA);
        hold.b = islands_.bodyOf(batch_, number, joint.slotB);
        hold.anchorA = toDouble(joint.anchorA);
        hold.anchorB = toDouble(joint.anchorB);
        hold.offset = toDouble(joint.centerOffset);
        hold.rate = static_cast<double>(joint.softness.biasRate);
        hold.rows[0].force = static_cast<double>(impulse) / static_cast<double>(h_);
        const auto place = static_cast<std::uint32_t>(island.holds().size());
        islands_.sources_.push_back({number, place, {&impulse, nullptr}, &joint.total});
        joint.total = {};
        if (joint.woundSpeed > 0) { island.allowWork(static_cast<double>(joint.woundSpeed)); }
        island.holds().push_back(hold);
        return island.holds().back();
    }
    void addPoint(JointConstraint& joint, Vec2& impulse) {
        IslandHold& hold = add(joint, IslandHold::Kind::point, impulse.x);
        hold.count = 2;
        hold.rows[1].force = static_cast<double>(impulse.y) / static_cast<double>(h_);
        islands_.sources_.back().impulses[1] = &impulse.y;
    }
    template <class Joint>
    void addSide(Joint& joint, Real& impulse) {
        // A unit of float is none of double: where gaps are closed it would leave some.
        const DVec2 axis = toDouble(joint.axis);
        add(joint, IslandHold::Kind::side, impulse).axis = axis / length(axis);
    }
    template <class Joint>
    void addAngle(Joint& joint, Real& impulse) {
        add(joint, IslandHold::Kind::angle, impulse).rest = static_cast<double>(joint.baseAngle);
    }

    /// @param motorImpulse  of a motor along either way
    static JointIslands::DriveSource drivenBy(FreedomParts& parts, Real& motorImpulse) {
        return {.motorImpulse = &motorImpulse, .springImpulse = &parts.springImpulse, .limits = &parts};
    }
    /// To the hold that was added last.
    void addDrives(const JointDrives& drives, JointIslands::DriveSource source) {
        if (!drives.turn && !drives.slide) { return; }
        JointIsland& island = islands_.parts_[islands_.sources_.back().part];
        IslandHold& hold = island.holds().back();
        hold.firstDrive = static_cast<std::uint32_t>(island.drives().size());
        const auto mayFlow = [&island](std::uint32_t i) {
            const IslandBody& body = island.bodies()[i];
            const bool moves = body.inverseMass > 0 || body.inverseInertia > 0;
            return !moves || JointFlow::mayTake(body);
        };
        if (!drives.areSmooth || !mayFlow(hold.a) || !mayFlow(hold.b)) { island.refuse(); }
        for (const std::optional<IslandDrive>* drive : {&drives.slide, &drives.turn}) {
            if (!*drive) { continue; }
            source.part = islands_.sources_.back().part;
            source.drive = static_cast<std::uint32_t>(island.drives().size());
            islands_.driveSources_.push_back(source);
            island.drives().push_back(**drive);
            ++hold.drives;
        }
    }

    JointIslands& islands_;
    SolverBatch& batch_;
    Real h_;
    DrivenStep step_;
};

void JointIslands::list(SolverBatch& batch) {
    const std::size_t slots = batch.states.size();
    finder_.reset(slots);
    forEachHeldKind(batch, [&](const auto& joints) {
        for (const auto& joint : joints) {
            const bool both = isMovable(batch.inertias[joint.slotA]) && isMovable(batch.inertias[joint.slotB]);
            if (both) { finder_.unite(joint.slotA, joint.slotB); }
        }
    });
    partOf_.assign(slots, kNoPart);
    bodyOf_.assign(slots, kNoNode);
    count_ = 0;
    for (BodySlot slot = 1; slot < slots; ++slot) {
        if (!isMovable(batch.inertias[slot])) { continue; }
        const BodySlot root = finder_.find(slot);
        if (root == slot) {
            if (parts_.size() == count_) { parts_.emplace_back(); }
            parts_[count_].clear();
            partOf_[slot] = count_++;
        } else {
            partOf_[slot] = partOf_[root];
        }
        bodyOf_[slot] = bodyOf(batch, partOf_[slot], slot);
    }
}

/// In its part. What cannot be moved, the ground or a kinematic body, has a copy in each part that it is tied to.
std::uint32_t JointIslands::bodyOf(const SolverBatch& batch, std::uint32_t part, BodySlot slot) {
    if (bodyOf_[slot] != kNoNode) { return bodyOf_[slot]; }
    std::vector<IslandBody>& bodies = parts_[part].bodies();
    bodies.push_back(bodyAt(batch, slot));
    return static_cast<std::uint32_t>(bodies.size() - 1);
}

/// Any worker may take the largest island.
void JointIslands::reserveFlows(std::size_t workers) {
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < count_; ++i) { most = std::max(most, parts_[i].bodies().size()); }
    if (flows_.size() < workers) { flows_.resize(workers); }
    for (JointFlow& flow : flows_) { flow.reserve(most); }
}

void JointIslands::readBack(SolverBatch& batch, int subSteps) {
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (parts_[i].isUndone()) { continue; }
        forgetVoidForces(parts_[i], batch, subSteps);
        for (const IslandBody& body : parts_[i].bodies()) {
            if (body.column == kNoNode) { continue; }
            BodyState& state = batch.states[body.slot];
            state.velocity = toReal(body.velocity);
            state.angularVelocity = static_cast<Real>(body.spin);
            state.deltaPosition = toReal(body.place.position);
            state.deltaAngle = static_cast<Real>(body.place.angle);
            state.deltaRotation = rotationFromAngle(static_cast<double>(state.deltaAngle));
        }
    }
    for (const Source& source : sources_) {
        if (parts_[source.part].isUndone()) { continue; }
        const IslandHold& hold = parts_[source.part].holds()[source.hold];
        for (std::size_t i = 0; i < hold.count; ++i) {
            *source.impulses[i] = static_cast<Real>(hold.rows[i].total / subSteps);
        }
        source.total->impulse += toReal(hold.reaction);
        source.total->twist += static_cast<Real>(hold.twist);
    }
    for (const DriveSource& source : driveSources_) {
        JointIsland& island = parts_[source.part];
        if (island.isUndone()) { continue; }
        const IslandDrive& drive = island.drives()[source.drive];
        // Of a wheel its turn comes last.
        if (source.motorImpulse != nullptr) { *source.motorImpulse = static_cast<Real>(drive.motorTotal / subSteps); }
        if (drive.hasSpring) { *source.springImpulse = static_cast<Real>(drive.springTotal / subSteps); }
        if (drive.hasLimits) { source.limits->lowerImpulse = source.limits->upperImpulse = 0; }
    }
}

void JointIslands::solve(SolverBatch& batch, Real h, int subSteps, TaskSystem& loops, SolveReport& report) {
    list(batch);
    sources_.clear();
    driveSources_.clear();
    HoldWriter writer(*this, batch, h, subSteps);
    forEachHeldKind(batch, [&](auto& joints) {
        for (auto& joint : joints) {
            if (isMovable(batch.inertias[joint.slotA]) || isMovable(batch.inertias[joint.slotB])) { writer(joint); }
        }
    });
    reserveFlows(static_cast<std::size_t>(loops.workerCount()));
    loops.run(count_, kIslandGrain, [&](std::size_t begin, std::size_t end, int worker) {
        JointFlow& flow = flows_[static_cast<std::size_t>(worker)];
        for (std::size_t i = begin; i < end; ++i) {
            parts_[i].prepare();
            parts_[i].advance(static_cast<double>(h), subSteps, flow);
        }
    });
    anyUndone_ = false;
    for (std::uint32_t i = 0; i < count_; ++i) {
        const JointIsland& island = parts_[i];
        anyUndone_ = anyUndone_ || island.isUndone();
        report.direct.factorisations += island.factorisations();
        report.direct.givenUp += island.isSoft() ? 1 : 0;
        report.mostSubSteps = std::max(report.mostSubSteps, island.subSteps());
        report.bodySubSteps += island.movedBodies() * static_cast<std::uint64_t>(island.subSteps());
    }
    readBack(batch, subSteps);
}

}  // namespace swept::inline SWEPT_PRECISION
