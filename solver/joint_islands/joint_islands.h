#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/task_system.h"
#include "../graph/island_finder.h"
#include "../solve_report.h"
#include "../solver_batch.h"
#include "joint_island.h"

namespace swept::inline SWEPT_PRECISION {

/// Takes the islands of a batch that consists of rigid joints alone through a step, each on its own: neither contacts
/// nor neighbours have a part in it. Hinges, sliders and wheels of islands without loops may have springs, limits and
/// motors, and welds springs that hold the angle: those that may not go on smoothly through the step are left as they
/// are.
class JointIslands {
public:
    /// @pre no contacts; all joints are hinges, rods, welds, sliders, and wheels, rigid in the points that they hold.
    /// Drives of bodies are those of half a sub-step.
    void solve(SolverBatch& batch, Real h, int subSteps, TaskSystem& loops, SolveReport& report);
    /// Of what can be moved, in the last solve: whether joints that could not all hold gave way in an island that hangs
    /// on nothing. What that gained nobody took back: it goes as a whole, too, which here is no concern.
    bool gaveWay(BodySlot slot) const {
        const JointIsland& part = parts_[partOf_[slot]];
        return part.isSoft() && part.isFree();
    }

    /// Whether the last solve left any island.
    bool anyUndone() const { return anyUndone_; }
    /// Whether it left that of a body that can be moved.
    bool isUndone(BodySlot slot) const { return parts_[partOf_[slot]].isUndone(); }

private:
    void list(SolverBatch& batch);
    std::uint32_t bodyOf(const SolverBatch& batch, std::uint32_t part, BodySlot slot);
    void reserveFlows(std::size_t workers);
    void readBack(SolverBatch& batch, int subSteps);

    /// Where impulses of a drive go to.
    struct DriveSource {
        std::uint32_t part = 0;
        std::uint32_t drive = 0;
        Real* motorImpulse = nullptr;
        Real* springImpulse = nullptr;
        FreedomParts* limits = nullptr;
    };
    /// Where the impulses of a hold come from and go to.
    struct Source {
        std::uint32_t part = 0;
        std::uint32_t hold = 0;
        Real* impulses[2] = {nullptr, nullptr};
        JointReaction* total = nullptr;
    };
    friend class HoldWriter;

    IslandFinder finder_;
    std::vector<std::uint32_t> partOf_;  ///< by slot
    std::vector<std::uint32_t> bodyOf_;  ///< in its part, by slot; of what can be moved
    std::vector<JointIsland> parts_;     ///< keep their capacities, and the order of their matrices
    std::uint32_t count_ = 0;            ///< in use
    std::vector<JointFlow> flows_;       ///< by worker; scratch
    std::vector<Source> sources_;
    std::vector<DriveSource> driveSources_;
    bool anyUndone_ = false;
};

}  // namespace swept::inline SWEPT_PRECISION
