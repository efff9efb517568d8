#pragma once

#include <cstdint>
#include <vector>

#include "../shapes/raw_vector.h"
#include "broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// Sorts pairs ascending, keeping its scratch space from call to call.
class PairOrder {
public:
    /// @param slotCount  above every slot in `pairs`.
    void sort(std::vector<ProxyPair>& pairs, std::uint32_t slotCount, TaskSystem& loops);
    std::size_t memoryBytes() const {
        return starts_.capacity() * sizeof(std::uint32_t) + sorted_.capacity() * sizeof(ProxyPair);
    }

private:
    std::vector<std::uint32_t> starts_;
    RawVector<ProxyPair> sorted_;
};

}  // namespace swept::inline SWEPT_PRECISION
