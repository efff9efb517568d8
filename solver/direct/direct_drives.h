#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../solve_report.h"
#include "../solver_batch.h"
#include "direct_joints.h"
#include "direct_rows.h"
#include "direct_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Motors in a direct solve: dampers with limits that are given. What is within them is held, the rest pushes as hard
/// as it may.
class DirectDrives {
public:
    /// Which bodies motor joints tie. Where one joint has its bodies for itself, iteration has nothing to bring
    /// together (a thousand cars seen from above, each rubbing on the ground).
    /// @param ties  by slot; what other joints tie is told already
    static void tieBodies(const SolverBatch& batch, std::span<BodyTie> ties);
    /// Tells joints whether their motors are rows here (`JointConstraint::isDriveHeld`).
    static void mark(SolverBatch& batch, const DirectSystem& system, bool areHeld);

    /// Once a step. @param isWhole  all of the drive comes before the motion, none after it
    void begin(bool isWhole);
    /// Before each solve. @param useBias  as in the kernels of the constraints: the first half of a sub-step
    void gather(SolverBatch& batch, DirectSystem& system, Real h, bool useBias);

    bool isEmpty() const { return drives_.empty(); }
    /// The matrix of joints and motors, as these are held.
    void assemble(DirectSystem& system, const DirectJoints& joints, DirectReport& report) const;
    /// The change that they make.
    void computeChange(DirectSystem& system, const DirectJoints& joints) const;
    /// From the first solution on, until motors stay within their limits.
    void search(DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    /// Takes back what iteration did to the rows since the last solve, see `DirectSolver::holdAgain`.
    void searchAgain(DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    void write(const DirectSystem& system);

    // --- after a solve: what contacts ask of them (`JointedContacts`)
    /// What there is now is right: of it only changes are found.
    void takeUp(std::span<const BodyState> states);
    /// @return whether contacts ask for more than some motor has, which then pushes as hard as it may
    bool letGo(const DirectSystem& system);
    /// What motors change that push as hard as they may.
    void pushForced(DirectSystem& system) const;
    void writeLater(const DirectSystem& system);

private:
    /// Of a motor: of its direction and zero, or of its two.
    using Push = std::array<double, 2>;
    /// One direction of a motor.
    struct DriveRow {
        SystemRow row;
        DirectRow held;
        double before = 0;  ///< impulse that was applied before the solve
    };
    /// A motor. One that drives a point has two directions, and its limit is of the length of both.
    struct Drive {
        std::array<DriveRow, 2> rows;
        std::size_t count = 1;
        double most = 0;             ///< in this solve, to any side
        bool keepsLastPush = false;  ///< expects what the sub-step before ended with, see `expect`
        Hold hold = Hold::held;
        Push along{};      ///< forced: in which direction, of unit length
        double share = 0;  ///< forced, with two: what is left of its strength across that
        Push given{};      ///< forced, in scope `jointed`: N·s or N·m·s

        std::span<DriveRow> all() { return std::span(rows).first(count); }
        std::span<const DriveRow> all() const { return std::span(rows).first(count); }
    };
    /// How a motor was held in the same half of the sub-step before.
    struct Memory {
        Hold hold = Hold::held;
        Push along{};
        double share = 0;
    };

    void expect();
    void addTo(DirectSystem& system) const;
    void push(DirectSystem& system) const;
    bool classifyAll(const DirectSystem& system, int round);
    static bool classify(const DirectSystem& system, Drive& drive, int round);
    static Push excessesOf(const DirectSystem& system, const Drive& drive);
    static Push pullAt(const DirectSystem& system, const Drive& drive, const Push& excess);
    static Push impulseAt(const DirectSystem& system, const Drive& drive, const Push& excess);
    static Push laterImpulseOf(const DirectSystem& system, const Drive& drive);

    std::vector<MotorRow> rows_;
    std::vector<Drive> drives_;
    std::array<std::vector<Memory>, 2> remembered_;  ///< of them, with bias and without, in this step
    std::vector<Push> ended_;                        ///< with what they ended the sub-step before
    bool isFirstHalf_ = true;                        ///< the present solve is the one with bias
    bool isWhole_ = false;                           ///< each solve is for all of the drive
};

}  // namespace swept::inline SWEPT_PRECISION
