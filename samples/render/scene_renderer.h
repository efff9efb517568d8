#pragma once

#include <memory>
#include <span>
#include <string>

#include "../frame.h"
#include "../scene_description.h"
#include "image.h"
#include "motion_trails.h"
#include "render_canvas.h"
#include "render_options.h"
#include "render_overlay.h"
#include "render_paint.h"
#include "render_scene.h"
#include "render_view.h"

namespace swept {

/// Another run of the same scene, drawn as outlines on top of the first.
struct Reference {
    const Frame* frame = nullptr;
    std::string ours;    ///< what the filled bodies are, for the legend
    std::string theirs;  ///< what the outlines are
};

/// Draws frames of one scene. The same frame gives the same bytes, in every process. Use from one thread at a time.
class SceneRenderer {
public:
    /// @return null, and a reason in `error`, when the size or the view is unusable, the body to follow is none of the
    ///         scene, or there is no off-screen OpenGL.
    static std::unique_ptr<SceneRenderer> create(const SceneDescription& scene, const RenderOptions& options,
                                                 std::string& error);

    /// Bodies whose pose is not finite are left out; the picture says how many. A view that follows one stays.
    /// @return an empty picture if OpenGL fails.
    Image draw(const Frame& frame);
    Image draw(const Frame& frame, const Reference& reference);

    /// For `RenderOptions::trails`: remembers positions for the lines, or poses for pale copies. A frame is not part of
    /// the picture of itself until it is added.
    void addTrail(const Frame& frame) { trails_.addPositions(frame); }
    void addStrobe(const Frame& frame) { trails_.addStrobe(frame); }
    void clearTrails() { trails_.clear(); }

    /// Frames do not say which joints broke. From now on, those of the events of type `jointBreak` are not drawn.
    void removeBrokenJoints(std::span<const SceneEvent> events);

    /// Of the frame that was drawn last.
    const PixelView& view() const { return view_; }

private:
    SceneRenderer(const SceneDescription& scene, const RenderOptions& options, std::unique_ptr<RenderCanvas> canvas);
    Image drawFrame(const Frame& frame, const Reference* reference);
    void moveView(const Frame& frame);
    void drawMarks(const Frame& frame);
    void drawOverlay(const Frame& frame, const Reference* reference);

    RenderOptions options_;
    PixelView view_;
    std::string title_;
    double dt_;
    std::vector<LegendEntry> legend_;
    SceneDrawing drawing_;
    MotionTrails trails_;
    OverlayMetrics metrics_;
    Paint paint_;
    std::unique_ptr<RenderCanvas> canvas_;
};

}  // namespace swept
