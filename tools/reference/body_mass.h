#pragma once

#include <swept/samples/scene_description.h>

namespace swept {

/// Mass, centre and inertia of a body, in double.
struct BodyMass {
    double mass = 0;
    DVec2 center;        ///< body frame
    double inertia = 0;  ///< about the centre of mass
};

/// Exact mass of a body's shapes, with the overrides of the description applied.
BodyMass massOfBody(const BodyDescription& body);

}  // namespace swept
