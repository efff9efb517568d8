#pragma once

#include "../frame.h"
#include "render_paint.h"
#include "render_scene.h"
#include "render_view.h"

/// What the solver knows, on top of the bodies.

namespace swept {

/// A dot at each contact point and an arrow of constant length along its normal, from a to b.
void drawContacts(Paint& paint, const PixelView& view, const Frame& frame);
/// An arrow from the origin of each awake body, as long as its way in `seconds`.
void drawVelocities(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame, double seconds);
/// The bodies at the poses at which they met something within the step.
void drawImpacts(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame);

/// What the bodies that met something, or moved farther than they are wide, swept within the step; below the bodies.
void drawSweptAreas(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame);
/// Where they were at the start and at their impacts, and the normals of those; on top of the bodies.
void drawSweptPoses(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame);
/// "lost 4.2 ms" beside each body that did not use its whole step.
void drawLostTimes(Paint& paint, const PixelView& view, const Frame& frame, double textHeight);

}  // namespace swept
