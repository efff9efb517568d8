#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The angle of a slider is as soft as what turns asks for, up to a lever of 64 radii of gyration; this is its square.
/// Beyond that its response is held down as the one of B's anchor asks, whose gap is the lever times the angle.
///
/// What softness gives back damps a light body that holds the angle of heavy ones: a pass turns little but the light
/// one, impulses of its rows add up meanwhile, and rows that keep them swing without end. (With 1, stiff from the
/// first radius on, a disc of 0.8 kg on sliders with two of 12.6 trembled for ever in profile `fast`; `LightBetween`.)
inline constexpr Real kFreeAngle = 64 * 64;

}  // namespace swept::inline SWEPT_PRECISION
