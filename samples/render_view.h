#pragma once

#include "render_options.h"
#include "render_paint.h"
#include "scene_description.h"

namespace swept {

/// Takes world coordinates to pixels. Differences to the centre are formed in double, so that a scene far from the origin
/// looks like one at the origin.
struct PixelView {
    DVec2 center;      ///< world, metres
    double scale = 1;  ///< pixels per metre
    DVec2 middle;      ///< of the picture, pixels

    DVec2 toPixels(DVec2 world) const { return middle + scale * (world - center); }
};

/// Takes coordinates of a body to pixels.
class PixelPose {
public:
    PixelPose(const PixelView& view, DVec2 position, double angle);
    DVec2 toPixels(DVec2 local) const {
        return origin_ + DVec2{cosine_ * local.x - sine_ * local.y, sine_ * local.x + cosine_ * local.y};
    }
    DVec2 origin() const { return origin_; }
    double scale() const { return scale_; }
    bool finite() const { return isFinite(origin_) && isFinite({cosine_, sine_}); }

private:
    DVec2 origin_;
    double cosine_;  // times pixels per metre, like sine_
    double sine_;
    double scale_;
};

/// A view of the initial state: all moving bodies, and of the static ones what is near them.
/// @param aspect  width by height of the picture.
ViewDescription fittedView(const SceneDescription& scene, double aspect);

/// The view that the options or the scene ask for, or the fitted one.
PixelView pixelView(const SceneDescription& scene, const RenderOptions& options);

}  // namespace swept
