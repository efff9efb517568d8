#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../../shapes/real.h"
#include "../../solver/direct/direct_scope.h"

namespace swept::inline SWEPT_PRECISION {

/// What asks for other passes of relaxation than usual.
enum class Stir : std::uint8_t {
    none,
    crowd,     ///< jostling, not carrying: one pass after each solve does
    struck,    ///< something squeezes a body against others (blows.h): more passes
    wasStruck  ///< in the step before: likewise
};

/// How the solver treats an island: into how many sub-steps it divides the step, and what it solves all at once instead
/// of by iteration. Islands of one class are one solve.
struct Effort {
    std::int8_t doublings = 0;  ///< of the sub-steps that the settings ask for; negative: halvings
    DirectScope direct = DirectScope::none;
    DirectScope left =
        DirectScope::freeJoints;  ///< of `islandsWithDrives`, where these are not smooth, or touch something
    Stir stir = Stir::none;
    /// Part of the key of a class only: the solver takes turns wherever a class of scope `joints` has contacts, so
    /// islands without any must be in another class.
    bool isInTurns = false;
    bool isLarge = false;  ///< a web of more than `kSmallWebBodies`: searched with more patience
    /// Which of those that were searched in vain in this step, from 1 on: a class of its own, since all others may be
    /// solved by then; 0: none.
    std::uint8_t retry = 0;
    bool isSettled = false;  ///< contacts are right as they are (settled.h): held in one sub-step, not solved anew

    constexpr bool isCrowd() const { return stir == Stir::crowd; }

    /// At once: a step compares thousands.
    bool operator==(const Effort& other) const { return std::memcmp(this, &other, sizeof(Effort)) == 0; }
};
static_assert(std::has_unique_object_representations_v<Effort> && sizeof(Effort) == 8, "copied and compared at once");

/// Doublings go up to this many sub-steps, unless the settings ask for more themselves.
inline constexpr int kMostSubSteps = 64;

/// At least 1.
constexpr int subStepsFor(Effort effort, int subSteps) {
    if (effort.isSettled) { return 1; }
    if (effort.doublings >= 0) { return subSteps << effort.doublings; }
    const int halved = subSteps >> -effort.doublings;
    return halved > 1 ? halved : 1;
}

/// After each solve of what is struck.
inline constexpr int kPassesOfBlow = 12;

/// After each solve.
constexpr int relaxPassesFor(Effort effort, int relaxPasses) {
    if (effort.isCrowd()) { return std::min(relaxPasses, 1); }
    const bool isBlow = effort.stir != Stir::none && relaxPasses > 0;
    return isBlow ? std::max(relaxPasses, kPassesOfBlow) : relaxPasses;
}

}  // namespace swept::inline SWEPT_PRECISION
