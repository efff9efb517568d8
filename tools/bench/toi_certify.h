#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "../toi/toi_families.h"
#include "../toi/toi_judge.h"
#include "toi_bench.h"

namespace swept::bench {

/// An answer that was not proved right, and where it comes from.
struct CertifyViolation {
    ToiFamily family = ToiFamily::generic;
    std::uint64_t index = 0;
    ToiVerdict verdict = ToiVerdict::undecided;
};

struct CertifyResult {
    std::array<std::int64_t, 8> counts{};      ///< by verdict
    std::vector<CertifyViolation> violations;  ///< the first hundred; `undecided` is none, it is the oracle's

    std::int64_t countOf(ToiVerdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
    std::int64_t wrong() const;
};

using ToiAnswerer = std::function<Toi(const ToiQuery&)>;

/// Has the answers judged, the reported separation, normal and witness points included, on `count` queries of all
/// families in turn: query i is number i / 20 of family i % 20.
CertifyResult certifyToi(const ToiAnswerer& answerer, std::int64_t count, std::uint64_t seed,
                         const std::function<void(std::int64_t)>& progress);

}  // namespace swept::bench
