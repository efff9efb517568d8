#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "oracle.h"

namespace swept::test {

/// Random queries by kind. All lengths are of order one unless the name says otherwise.
///
/// These are not the families of `swept toi --generate` (tools/toi/toi_families.h), on purpose. Those are made with the
/// help of the interval oracle's own geometry and judged by it; these share no line with either and are judged by
/// samples in long double (oracle.h), so that what one generator never makes, or one judge overlooks, has a second
/// chance to be seen. And the suite of the layer needs nothing but the layer.
enum class Family : std::uint8_t {
    generic,      ///< speeds up to three sizes a step, up to a quarter turn
    bars,         ///< slender, up to a whole turn
    manyTurns,    ///< several turns, close together
    parabola,     ///< accelerated, thrown up and falling back
    fast,         ///< hundreds of sizes a step
    far,          ///< a million from the origin, moving along together
    tinyAndHuge,  ///< sizes a factor of up to 10⁵ apart
    small,        ///< everything of size 1e-9
    large,        ///< everything of size 1e9
    close,        ///< starts around the target
    sliver,       ///< aspect ratios up to 10⁵
    offCenter,    ///< centres of mass outside the shapes
};

inline constexpr std::array kFamilies = {Family::generic, Family::bars,  Family::manyTurns,   Family::parabola,
                                         Family::fast,    Family::far,   Family::tinyAndHuge, Family::small,
                                         Family::large,   Family::close, Family::sliver,      Family::offCenter};

std::string_view nameOf(Family family);

/// The same seed gives the same query.
Query randomQuery(Family family, std::uint64_t seed);

}  // namespace swept::test
