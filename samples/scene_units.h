#pragma once

#include <string>
#include <vector>

#include "scene_description.h"
#include "scene_fields.h"

namespace swept {

/// A number of the scene format (each component of a vector counts) and the powers of length, mass and time in its
/// unit.
struct FieldUnit {
    std::string field;  ///< JSON pointer with `*` for an index: "/bodies/*/shapes/*/box/half"
    Dimension dimension;
};

/// The table that the page of the format shows: every number, in the order of the format; angles and plain numbers
/// have the dimension 0, 0, 0. Where a member of one name has another unit in a later type of joint, the type stands
/// behind it in parentheses: "/joints/*/lower (prismatic)". Of the `ratio` of a gear see `gearRatioUnit`.
std::vector<FieldUnit> sceneUnits();

/// The `ratio` of a gear has the unit of its first joint's coordinate per that of its second: a number, m or 1/m.
Dimension gearRatioUnit(const SceneDescription& scene, const GearDescription& gear);

/// "kg·m²", "m/s²"; "1" without dimension.
std::string unitText(const Dimension& dimension);

/// The same scene told in units of length, mass and time that are 2^lengthPower, 2^massPower, 2^timePower times
/// smaller: every dimensional number, settings and gravity included, times its power of two. Exact unless a number
/// over- or underflows. By the design the run is the same, bit for bit, up to those factors. Members left out stay out:
/// their automatic values depend on what is given.
SceneDescription scaled(const SceneDescription& scene, int lengthPower, int massPower, int timePower);

}  // namespace swept
