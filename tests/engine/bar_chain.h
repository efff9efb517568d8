#pragma once

#include <algorithm>
#include <string>

#include "joint_support.h"

/// What the suites of motors that hold rows of bars share.

namespace swept::test {

inline constexpr double kBarWeight = 40;  ///< N, of a bar of 2 m

inline WorldSettings settingsOf(Profile profile, bool sleeps = false) {
    WorldSettings settings = awakeSettings(profile);
    settings.sleep = sleeps;
    return settings;
}

/// What touches nothing, of a density. @param density  kg/m²
inline ShapeDef untouchable(double density) {
    ShapeDef def = material(0.6, 0, density);
    def.filter.mask = 0;
    return def;
}

/// @param times  as heavy as a bar
inline ShapeDef barOf(double times) { return untouchable(kBarWeight / kGravity / 0.8 * times); }

/// Of the last bar of a chain, over some seconds from now on, m/s.
template <class Chain>
double fastestTip(Chain& chain, double seconds) {
    double fastest = 0;
    for (int step = 0; step < seconds * kRate; ++step) {
        run(chain.world, 1);
        fastest = std::max(fastest, length(velocityOf(chain.world, chain.bars.back())));
    }
    return fastest;
}

}  // namespace swept::test
