#include "scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render_marks.h"
#include "render_style.h"

namespace swept {

namespace {

bool isFiniteState(const BodyFrame& body) { return isFinite(body.position) && std::isfinite(body.angle); }

}  // namespace

std::unique_ptr<SceneRenderer> SceneRenderer::create(const SceneDescription& scene, const RenderOptions& options,
                                                     std::string& error) {
    if (options.follow && *options.follow >= scene.bodies.size()) {
        error = "the body to follow is none of the scene";
        return nullptr;
    }
    std::unique_ptr<RenderCanvas> canvas =
        RenderCanvas::create(options.width, options.height, options.superSampling, error);
    if (!canvas) { return nullptr; }
    std::unique_ptr<SceneRenderer> renderer(new SceneRenderer(scene, options, std::move(canvas)));
    const PixelView& view = renderer->view_;
    if (!isFinite(view.center) || !std::isfinite(view.scale) || !(view.scale > 0)) {
        error = "the view must have a finite center and a height greater than 0";
        return nullptr;
    }
    return renderer;
}

SceneRenderer::SceneRenderer(const SceneDescription& scene, const RenderOptions& options,
                             std::unique_ptr<RenderCanvas> canvas)
    : options_(options),
      view_(pixelView(scene, options)),
      title_(scene.name),
      dt_(scene.settings.dt),
      legend_(legendEntries(scene, options)),
      drawing_(scene),
      trails_(options.trailPoints),
      metrics_(options),
      paint_(options.width, options.height),
      canvas_(std::move(canvas)) {}

Image SceneRenderer::draw(const Frame& frame) { return drawFrame(frame, nullptr); }

Image SceneRenderer::draw(const Frame& frame, const Reference& reference) {
    return drawFrame(frame, reference.frame != nullptr ? &reference : nullptr);
}

void SceneRenderer::removeBrokenJoints(std::span<const SceneEvent> events) {
    for (const SceneEvent& event : events) {
        if (event.type == SceneEventType::jointBreak) { drawing_.removeJoint(event.joint); }
    }
}

void SceneRenderer::moveView(const Frame& frame) {
    if (!options_.follow || *options_.follow >= frame.bodies.size()) { return; }
    const DVec2 beside = options_.view ? options_.view->center : DVec2{};
    const DVec2 center = beside + frame.bodies[*options_.follow].position;
    if (isFinite(center)) { view_.center = center; }
}

Image SceneRenderer::drawFrame(const Frame& frame, const Reference* reference) {
    paint_.clear();
    moveView(frame);
    if (options_.grid) { drawGrid(paint_, view_); }
    if (options_.trails) { trails_.draw(paint_, view_, drawing_); }
    if (options_.sweeps) { drawSweptAreas(paint_, view_, drawing_, frame); }
    drawing_.drawBodies(paint_, view_, frame);
    if (options_.joints) { drawing_.drawJoints(paint_, view_, frame); }
    if (reference != nullptr) { drawing_.drawOutlines(paint_, view_, *reference->frame, style::kReference); }
    drawMarks(frame);
    drawOverlay(frame, reference);
    return canvas_->draw(style::kBackground, paint_.triangles());
}

void SceneRenderer::drawMarks(const Frame& frame) {
    if (options_.ghosts) { drawImpacts(paint_, view_, drawing_, frame); }
    if (options_.sweeps) {
        drawSweptPoses(paint_, view_, drawing_, frame);
        drawLostTimes(paint_, view_, frame, 0.9 * metrics_.text);
    }
    if (options_.velocities) { drawVelocities(paint_, view_, drawing_, frame, options_.velocitySeconds); }
    if (options_.contacts) { drawContacts(paint_, view_, frame); }
    if (options_.labels) { drawing_.drawNames(paint_, view_, frame, 0.8 * metrics_.text); }
}

void SceneRenderer::drawOverlay(const Frame& frame, const Reference* reference) {
    const std::string clock = options_.time ? timeLabel(frame.time, dt_) : "";
    if (options_.title && !title_.empty()) { drawTitle(paint_, metrics_, title_, clock); }
    if (options_.sweeps && options_.sweepWork) { drawSweepWork(paint_, metrics_, frame.work); }
    if (options_.time) { drawTime(paint_, metrics_, clock); }
    if (options_.scaleBar) { drawScaleBar(paint_, metrics_, scaleBar(view_.scale, kScaleBarShare * options_.width)); }
    if (options_.legend && reference != nullptr) {
        const std::vector<LegendEntry> entries{
            dynamicLegend(reference->ours),
            {style::kBackground, style::kReference, reference->theirs, false, true, {}}};
        drawLegend(paint_, metrics_, entries);
    } else if (options_.legend) {
        drawLegend(paint_, metrics_, legend_);
    }
    const auto lost =
        std::count_if(frame.bodies.begin(), frame.bodies.end(), [](const BodyFrame& b) { return !isFiniteState(b); });
    if (lost > 0) {
        drawWarning(paint_, metrics_, std::to_string(lost) + (lost == 1 ? " body is" : " bodies are") + " not finite");
    }
}

}  // namespace swept
