#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

/// Steps much shorter than one just before them: what is left of a frame after whole steps (remainder_loads.h).

namespace swept::inline SWEPT_PRECISION {

struct RemainderSteps {
    double whole = 0;    ///< s, of the last step that was none
    double time = 0;     ///< s, of all since
    bool isOne = false;  ///< the present step, or the last one
};

/// What a contact begins a solve with, as long as it has so many points.
struct ContactStart {
    std::uint32_t contact = 0;  ///< index
    int points = 0;
    std::array<Real, 2> normalImpulse{};
    std::array<Real, 2> tangentImpulse{};
    bool pressedOn = false;
};

/// All impulses of a joint that it begins a solve with, in the order in which joint_growth.h visits them.
struct JointStart {
    static constexpr std::size_t kMost = 16;
    std::uint32_t joint = 0;  ///< index
    std::size_t count = 0;
    std::array<Real, kMost> impulses{};
};

/// Of a step that is such a one, until it ends.
struct RemainderLoads {
    std::vector<ContactStart> contacts;
    std::vector<JointStart> joints;
};

}  // namespace swept::inline SWEPT_PRECISION
