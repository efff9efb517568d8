#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../solver_batch.h"
#include "direct_rows.h"
#include "direct_system.h"
#include "tie_weights.h"

namespace swept::inline SWEPT_PRECISION {

/// How strong the rows of joints have to be where joints hold angles. A row may have to move all that they tie together
/// there, at the lever of all of it, and a damper that is no match for that is a spring, which its impulses, kept from
/// solve to solve, make swing without end.
class TieStrengths {
public:
    /// Once a step.
    void begin() { isAny_ = false; }
    /// Likewise, where they are asked for. @param holdsDrives  whether motors have rows as well @pre all is coupled
    void find(const SolverBatch& batch, const DirectSystem& system, bool holdsDrives);
    /// Makes a row of a joint as strong as that asks for, after `find`.
    void stiffen(const DirectSystem& system, std::span<const BodyInertia> inertias, const DirectRow& held,
                 SystemRow& row) const;

private:
    bool noteAngles(const SolverBatch& batch, const DirectSystem& system);

    bool isAny_ = false;                     ///< joints hold some angle; only then weights are known
    std::vector<std::uint8_t> holdsAngles_;  ///< by the first node of an island
    TieWeights weights_;                     ///< by node
    std::vector<TieWeights::Member> members_;
    std::vector<TieWeights::Link> links_;
};

}  // namespace swept::inline SWEPT_PRECISION
