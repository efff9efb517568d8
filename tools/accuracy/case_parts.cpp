#include "case_parts.h"

#include <algorithm>
#include <cmath>

namespace swept::accuracy {
namespace {

/// Positions at which the dynamic bodies of a scene begin; by index.
struct Start {
    int body;
    DVec2 position;
};
std::vector<Start> startsOf(const SceneDescription& scene) {
    std::vector<Start> starts;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].type == SceneBodyType::dynamic) {
            starts.push_back({static_cast<int>(i), scene.bodies[i].position});
        }
    }
    return starts;
}

template <class Part>
Measure worstOfMoves(const SceneDescription& scene, const char* name, double length, const Part& part) {
    return {name, "1", [starts = startsOf(scene), length, part](const Frames& frames) {
                double worst = 0;
                for (const Start& start : starts) {
                    worst = std::max(worst, part(bodyAt(frames.back(), start.body).position - start.position));
                }
                return worst / length;
            }};
}

}  // namespace

SceneDescription emptyScene(const std::string& name, double gravity) {
    SceneDescription scene = build::scene(name, {0, 0}, 10);
    scene.gravity = {0, -gravity};
    scene.settings.sleep = false;
    return scene;
}

void setSurface(SceneDescription& scene, double friction, double restitution) {
    for (BodyDescription& body : scene.bodies) {
        for (ShapeDescription& shape : body.shapes) {
            shape.friction = friction;
            shape.restitution = restitution;
        }
    }
}

int lastBody(const SceneDescription& scene) { return static_cast<int>(scene.bodies.size()) - 1; }

Measure worstMove(const SceneDescription& scene, double length) {
    return worstOfMoves(scene, "worst move", length, [](DVec2 move) { return swept::length(move); });
}

Measure drift(const SceneDescription& scene, double length) {
    return worstOfMoves(scene, "drift", length, [](DVec2 move) { return std::fabs(move.x); });
}

Measure sag(const std::string& name, int body, double length) {
    return {name, "1", [body, length](const Frames& frames) {
                return std::fabs(bodyAt(frames.front(), body).position.y - bodyAt(frames.back(), body).position.y) /
                       length;
            }};
}

Measure jitter(const SceneDescription& scene) {
    return {"jitter", "m/s", [starts = startsOf(scene)](const Frames& frames) {
                const double last = frames.back().time - 1;
                double fastest = 0;
                for (const Frame& frame : frames) {
                    for (const Start& start : starts) {
                        if (frame.time >= last) {
                            fastest = std::max(fastest, length(bodyAt(frame, start.body).velocity));
                        }
                    }
                }
                return fastest;
            }};
}

Verdict stands(const SceneDescription& scene, int top, double side, double gravity) {
    const double height = scene.bodies[static_cast<std::size_t>(top)].position.y;
    return [starts = startsOf(scene), top, side, gravity, height](const Frames& frames) -> std::string {
        const Frame& end = frames.back();
        const double fallen = bodyAt(frames.front(), top).position.y - bodyAt(end, top).position.y;
        if (!(fallen < 0.1 * std::max(side, std::fabs(height)))) { return "collapsed"; }
        for (const Start& start : starts) {
            const BodyFrame& body = bodyAt(end, start.body);
            if (!(std::fabs(body.position.x - start.position.x) < side)) { return "collapsed"; }
            if (!(length(body.velocity) < 0.01 * std::sqrt(gravity * side))) { return "moving"; }
        }
        return "";
    };
}

Verdict staysWithin(double limit) {
    return [limit](const Frames& frames) -> std::string {
        for (const BodyFrame& body : frames.back().bodies) {
            if (!(std::fabs(body.position.x) < limit && std::fabs(body.position.y) < limit)) { return "escaped"; }
        }
        return "";
    };
}

const Frame& frameAt(const Frames& frames, double time) {
    const auto later = [time](const Frame& a, const Frame& b) {
        return std::fabs(a.time - time) < std::fabs(b.time - time);
    };
    return *std::min_element(frames.begin(), frames.end(), later);
}

}  // namespace swept::accuracy
