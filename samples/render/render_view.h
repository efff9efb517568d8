#pragma once

#include <cstddef>

#include "../scene_description.h"
#include "render_options.h"
#include "render_paint.h"

namespace swept {

/// Takes world coordinates to pixels. Differences to the centre are formed in double, so that a scene far from the
/// origin looks like one at the origin.
struct PixelView {
    DVec2 center;      ///< world, metres
    double scale = 1;  ///< pixels per metre
    DVec2 middle;      ///< of the picture, pixels
    double pen = 1;    ///< widths of lines and sizes of marks, in pixels, are multiplied by this

    DVec2 toPixels(DVec2 world) const { return middle + scale * (world - center); }
};

/// Takes coordinates of a body to pixels.
class PixelPose {
public:
    PixelPose(const PixelView& view, DVec2 position, double angle);
    DVec2 toPixels(DVec2 local) const {
        // Metres first: a corner of a huge body close to the centre must not lose digits to the size of the body.
        const DVec2 turned{cosine_ * local.x - sine_ * local.y, sine_ * local.x + cosine_ * local.y};
        return middle_ + scale_ * (offset_ + turned);
    }
    DVec2 origin() const { return middle_ + scale_ * offset_; }
    double scale() const { return scale_; }
    double pen() const { return pen_; }
    bool finite() const { return isFinite(origin()) && isFinite(DVec2{cosine_, sine_}); }

private:
    DVec2 offset_;  // from the centre of the view, metres
    DVec2 middle_;
    double cosine_;
    double sine_;
    double scale_;
    double pen_;
};

/// A view of the initial state: all moving bodies, and of the static ones what is near them.
/// @param aspect  width by height of the picture.
ViewDescription fittedView(const SceneDescription& scene, double aspect);

/// Metres to either side of the centre of a view that the bodies of a scene take up. Those that are not whole within
/// `most` do not count: they are seen in part, or not at all, in any case.
double halfWidthOf(const SceneDescription& scene, const ViewDescription& view, double most);

/// Height of a view that moves with a body: a few times as far as the body reaches from its origin, at most that of the
/// scene's own view or the fitted one.
/// @param aspect  width by height of the picture.
double followingHeight(const SceneDescription& scene, std::size_t body, double aspect);

/// How large lines and letters are in a picture, against one of 960 × 540.
double penScale(const RenderOptions& options);

/// The view that the options or the scene ask for, or the fitted one; of the initial state where it follows a body.
/// @param options  follows nobody, or a body of the scene.
PixelView pixelView(const SceneDescription& scene, const RenderOptions& options);

}  // namespace swept
