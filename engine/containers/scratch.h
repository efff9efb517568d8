#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What a step makes anew before it asks for it, and that is kept for its capacity alone: copies of what holds it have
/// one of their own, that was not used yet, and what is assigned to keeps its own.
template <class T>
struct Scratch : T {
    using T::operator=;
    Scratch() = default;
    Scratch(const Scratch& /*other*/) : T() {}
    Scratch& operator=(const Scratch& /*other*/) { return *this; }
    ~Scratch() = default;
};

}  // namespace swept::inline SWEPT_PRECISION
