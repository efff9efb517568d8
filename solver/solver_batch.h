#pragma once

#include <vector>

#include "../shapes/raw_vector.h"
#include "body_state.h"
#include "contacts/contact_constraint.h"
#include "contacts/contact_store.h"
#include "joint_blocks/hinge_store.h"
#include "joints/distance_constraint.h"
#include "joints/gear_constraint.h"
#include "joints/motor_constraint.h"
#include "joints/mouse_constraint.h"
#include "joints/prismatic_constraint.h"
#include "joints/pulley_constraint.h"
#include "joints/revolute_constraint.h"
#include "joints/weld_constraint.h"
#include "joints/wheel_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Everything one coloured solve works on: bodies by slot, constraints by kind, each kind contiguous. The engine fills
/// it anew each step (capacities stay), `Solver` sorts the constraints by colour, the engine reads the results by
/// `source`. This is the seam between engine and solver: wide kernels and threads change what is behind it, not what is
/// in front.
struct SolverBatch {
    // Who resizes these sets what is new in them.
    RawVector<BodyState> states;
    RawVector<BodyInertia> inertias;
    RawVector<BodyDrive> drives;
    std::vector<ContactConstraint> contacts;
    /// Instead of `contacts`, which the solver then fills with what stands in no block: contacts of a store. Only where
    /// nothing bounces, or in its turn, and nothing is solved all at once.
    RawVector<ContactLink> links;
    ContactStore* store = nullptr;  ///< null: there are no links
    std::vector<RevoluteConstraint> revolutes;
    /// Instead of `revolutes`, as it is with contacts: hinges of a store. Only where nothing is solved all at once.
    std::vector<HingeLink> hingeLinks;
    HingeStore* hingeStore = nullptr;  ///< null: there are no such links
    std::vector<DistanceConstraint> distances;
    std::vector<PrismaticConstraint> prismatics;
    std::vector<WheelConstraint> wheels;
    std::vector<WeldConstraint> welds;
    std::vector<MotorConstraint> motors;
    std::vector<MouseConstraint> mice;
    std::vector<GearConstraint> gears;
    std::vector<PulleyConstraint> pulleys;
    bool mayGlide = false;  ///< limits or lengths of some joint may move

    /// Calls `visit` with the array of each kind of joint, in the order in which a colour solves them; contacts come
    /// after.
    template <class Visit>
    void forEachJointKind(Visit&& visit) {
        visit(revolutes);
        visit(distances);
        visit(prismatics);
        visit(wheels);
        visit(welds);
        visit(motors);
        visit(mice);
        visit(gears);
        visit(pulleys);
    }

    /// Empties all, and lays down the fixed world as slot 0.
    void clear() {
        clearAllButJoints();
        clearJoints();
    }
    void clearAllButJoints() {
        states.assign(1, {});
        inertias.assign(1, {});
        drives.assign(1, {});
        contacts.clear();
        links.clear();
        store = nullptr;
    }
    void clearJoints() {
        forEachJointKind([](auto& joints) { joints.clear(); });
        hingeLinks.clear();
        hingeStore = nullptr;
        mayGlide = false;
    }
    bool hasHinges() const { return !revolutes.empty() || !hingeLinks.empty(); }
    BodySlot addBody(const BodyState& state, const BodyInertia& inertia, const BodyDrive& drive) {
        states.push_back(state);
        inertias.push_back(inertia);
        drives.push_back(drive);
        return static_cast<BodySlot>(states.size() - 1);
    }
};

}  // namespace swept::inline SWEPT_PRECISION
