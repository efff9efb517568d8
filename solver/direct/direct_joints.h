#pragma once

#include <span>
#include <vector>

#include "../solver_batch.h"
#include "direct_rows.h"
#include "direct_system.h"
#include "tie_strengths.h"

namespace swept::inline SWEPT_PRECISION {

/// What joints hold rigidly in a direct solve.
class DirectJoints {
public:
    /// Once a step.
    void begin();
    /// Likewise, where contacts have no rows: how strong those of joints are. @pre all is coupled
    void weigh(const SolverBatch& batch, const DirectSystem& system, bool holdsDrives) {
        ties_.find(batch, system, holdsDrives);
    }
    /// See `DirectSolver`.
    void setLeastClosing(Real seconds) { leastClosing_ = seconds; }
    void noteMotions(std::span<const BodyState> states);

    /// Before each solve. @param useBias  as in the kernels of the constraints
    void gather(SolverBatch& batch, DirectSystem& system, Real h, bool useBias);
    /// Before bodies are moved without speeds: nothing is off but by what they are.
    void gatherAtRest(SolverBatch& batch, DirectSystem& system, Real h);
    /// The same rows as before, at the present velocities; all that they carry is right.
    void gatherAgain(std::span<const BodyState> states);

    bool isEmpty() const { return joints_.empty(); }
    void addTo(DirectSystem& system) const;
    void push(DirectSystem& system) const;
    /// What they carry after the change that was found.
    void write(const DirectSystem& system);
    /// Likewise, of a change that came after that.
    void writeLater(const DirectSystem& system);
    /// They carry nothing.
    void forget();

private:
    struct HeldJoint {
        SystemRow row;
        Real* impulse = nullptr;
        double forgotten = 0;  ///< of the impulse, N·s or N·m·s; taken back, to be found again
    };

    void listRows(SolverBatch& batch, Real h, bool useBias);

    SystemRow rowOf(std::span<const BodyInertia> inertias, DirectSystem& system, const DirectRow& held) const;

    Real leastClosing_ = 0;  ///< s
    TieStrengths ties_;
    std::vector<Motion> motions_;  ///< by slot; empty: not noted
    std::vector<DirectRow> rows_;
    std::vector<HeldJoint> joints_;
};

}  // namespace swept::inline SWEPT_PRECISION
