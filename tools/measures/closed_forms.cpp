#include "closed_forms.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "../inspect/placed_scene.h"

namespace swept::measures {
namespace {

bool anythingCollides(const PlacedScene& placed) {
    for (std::size_t i = 0; i < placed.pieces.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (mayCollide(placed, placed.pieces[i], placed.pieces[k])) { return true; }
        }
    }
    return false;
}

int onlyDynamicBody(const PlacedScene& placed) {
    int found = -1;
    for (const PlacedBody& body : placed.bodies) {
        if (body.isDynamic()) {
            if (found >= 0) { return -1; }
            found = body.index;
        } else if (body.description->type == SceneBodyType::kinematic) {
            return -1;
        }
    }
    return found;
}

/// Exact solution of x″ = a − c·x′ after a time.
DVec2 wayOf(DVec2 velocity, DVec2 acceleration, double damping, double time) {
    if (damping == 0) { return time * velocity + (0.5 * time * time) * acceleration; }
    const double phi1 = -std::expm1(-damping * time) / damping;
    return phi1 * velocity + ((time - phi1) / damping) * acceleration;
}

std::optional<ClosedForm> freeFlight(const SceneDescription& scene, const PlacedScene& placed) {
    const bool isFree = scene.joints.empty() && !anythingCollides(placed) && !scene.settings.maxSpeed;
    const auto turns = [&](const PlacedBody& body) {  // the origin of such a body circles about its centre
        return body.isDynamic() && body.description->angularVelocity != 0 && !(body.center == body.pose.position);
    };
    if (!isFree || std::any_of(placed.bodies.begin(), placed.bodies.end(), turns)) { return std::nullopt; }
    return ClosedForm{"free flight", [bodies = scene.bodies, gravity = scene.gravity](int index, double time) {
                          const BodyDescription& body = bodies[static_cast<std::size_t>(index)];
                          switch (body.type) {
                              case SceneBodyType::fixed:
                                  return body.position;
                              case SceneBodyType::kinematic:
                                  return body.position + time * body.velocity;
                              case SceneBodyType::dynamic:
                                  break;
                          }
                          return body.position +
                                 wayOf(body.velocity, body.gravityScale * gravity, body.linearDamping, time);
                      }};
}

/// Bounces shorter than this part of a step are invisible; with restitution below 1 there are infinitely many.
constexpr double kShortestBounce = 1.0 / 1024;

/// Height above the level at which a ball bounces, time after time.
struct Bounces {
    double height;   ///< of the start, m
    double speed;    ///< at the start, upwards, m/s
    double gravity;  ///< downwards, m/s²
    double restitution;
    double shortest;  ///< s: shorter bounces are none

    double heightAt(double time) const {
        double impact = (speed + std::sqrt(speed * speed + 2 * gravity * height)) / gravity;
        if (time < impact) { return height + (speed - 0.5 * gravity * time) * time; }
        double rise = restitution * (gravity * impact - speed);
        for (double flight = 2 * rise / gravity; flight > shortest; rise *= restitution, flight = 2 * rise / gravity) {
            if (time < impact + flight) {
                const double since = time - impact;
                return (rise - 0.5 * gravity * since) * since;
            }
            impact += flight;
        }
        return 0;
    }
};

std::optional<ClosedForm> bouncingBall(const SceneDescription& scene, const PlacedScene& placed) {
    const int ball = onlyDynamicBody(placed);
    if (ball < 0 || scene.bodies.size() != 2 || placed.pieces.size() != 2 || !scene.joints.empty()) {
        return std::nullopt;
    }
    const BodyDescription& body = scene.bodies[static_cast<std::size_t>(ball)];
    const BodyDescription& ground = scene.bodies[static_cast<std::size_t>(1 - ball)];
    const auto* const circle = std::get_if<CircleGeometry>(&body.shapes[0].geometry);
    const auto* const box = std::get_if<BoxGeometry>(&ground.shapes[0].geometry);
    const bool isDragged = body.shapes[0].surfaceSpeed + ground.shapes[0].surfaceSpeed != 0;
    const bool isBall = circle != nullptr && !isDragged && circle->center == DVec2{} && body.angularVelocity == 0 &&
                        body.linearDamping == 0 && body.velocity.x == 0;
    const bool isLevel = box != nullptr && ground.angle == 0 && box->angle == 0 && scene.gravity.x == 0;
    const double gravity = -scene.gravity.y * body.gravityScale;
    if (!isBall || !isLevel || !(gravity > 0) || !mayCollide(placed, placed.pieces[0], placed.pieces[1])) {
        return std::nullopt;
    }
    const double side = std::fabs(body.position.x - ground.position.x - box->center.x);
    const double level = ground.position.y + box->center.y + box->half.y + ground.shapes[0].radius + circle->radius;
    if (!(side < box->half.x) || !(body.position.y >= level)) { return std::nullopt; }
    const Bounces bounces{body.position.y - level, body.velocity.y, gravity,
                          mixedRestitution(body.shapes[0], ground.shapes[0]), kShortestBounce * scene.settings.dt};
    return ClosedForm{"bouncing ball", [=, at = ground.position, x = body.position.x](int index, double time) {
                          return index == ball ? DVec2{x, level + bounces.heightAt(time)} : at;
                      }};
}

/// Angles of a physical pendulum, θ″ = −(g/L)·sin θ − c·θ′, at the ends of steps; straight lines between them.
struct Swing {
    double step;
    std::vector<double> angles;

    double angleAt(double time) const {
        const double place = time / step;
        const auto i = std::min(static_cast<std::size_t>(place), angles.size() - 2);
        return angles[i] + (place - static_cast<double>(i)) * (angles[i + 1] - angles[i]);
    }
};

Swing swing(double angle, double rate, double stiffness, double duration) {
    // Straight lines err by θ″·step²/8, so the step follows from 1e-10 rad and the largest θ″.
    constexpr double kAngleError = 1e-10;
    constexpr double kMostSteps = 4e6;
    const double step = std::max(std::sqrt(8 * kAngleError / stiffness), duration / kMostSteps);
    Swing result{step, {angle}};
    const auto count = static_cast<std::size_t>(std::ceil(duration / step)) + 2;
    result.angles.reserve(count);
    const auto pull = [stiffness](double a) { return -stiffness * std::sin(a); };
    for (std::size_t i = 0; i < count; ++i) {
        const double k1 = pull(angle);
        const double k2 = pull(angle + 0.5 * step * rate);
        const double k3 = pull(angle + 0.5 * step * rate + 0.25 * step * step * k1);
        const double k4 = pull(angle + step * rate + 0.5 * step * step * k2);
        angle += step * rate + step * step / 6 * (k1 + k2 + k3);
        rate += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        result.angles.push_back(angle);
    }
    return result;
}

std::optional<ClosedForm> pendulum(const SceneDescription& scene, const PlacedScene& placed, double duration) {
    const int bob = onlyDynamicBody(placed);
    const auto* const hinge =
        scene.joints.size() == 1 ? std::get_if<RevoluteDescription>(&scene.joints[0].joint) : nullptr;
    if (bob < 0 || hinge == nullptr) { return std::nullopt; }
    const JointDescription& joint = scene.joints[0];
    const PlacedBody& placedBob = placed.bodies[static_cast<std::size_t>(bob)];
    const BodyDescription& body = scene.bodies[static_cast<std::size_t>(bob)];
    const bool isPlain = !hinge->lower && !hinge->upper && !hinge->motorSpeed && !hinge->maxMotorTorque &&
                         !hinge->hertz && !hinge->anchorB && !joint.breakForce && !joint.breakTorque;
    const bool isHung = joint.bodyA == placedBob.name || joint.bodyB == placedBob.name;
    const bool isUndisturbed = body.linearDamping == 0 && body.angularDamping == 0 && !body.fixedRotation &&
                               !scene.settings.maxSpeed && body.awake;
    // With one other body, joined, nothing else can be met.
    const bool isAlone = scene.bodies.size() == 2 && !joint.collideConnected;
    const DVec2 arm = placedBob.center - hinge->anchor;
    const double gravity = length(scene.gravity) * body.gravityScale;
    if (!isPlain || !isHung || !isUndisturbed || !isAlone || !(gravity > 0) || !(length(arm) > 0) ||
        !(placedBob.inertia > 0)) {
        return std::nullopt;
    }
    const double aboutHinge = placedBob.inertia + placedBob.mass * dot(arm, arm);
    const double stiffness = placedBob.mass * gravity * length(arm) / aboutHinge;
    const DVec2 down = (1 / length(scene.gravity)) * scene.gravity;
    const double start = std::atan2(cross(down, arm), dot(down, arm));
    // A velocity that the hinge does not allow is taken away by it: what turns about it stays.
    const double rate =
        (placedBob.mass * cross(arm, body.velocity) + placedBob.inertia * body.angularVelocity) / aboutHinge;
    const auto path = std::make_shared<const Swing>(swing(start, rate, stiffness, duration));
    return ClosedForm{"pendulum", [=, bodies = scene.bodies, anchor = hinge->anchor](int index, double time) {
                          const DVec2 at = bodies[static_cast<std::size_t>(index)].position;
                          if (index != bob) { return at; }
                          const double turn = path->angleAt(time) - start;
                          const DVec2 from = at - anchor;
                          return anchor + DVec2{std::cos(turn) * from.x - std::sin(turn) * from.y,
                                                std::sin(turn) * from.x + std::cos(turn) * from.y};
                      }};
}

}  // namespace

std::optional<ClosedForm> closedFormOf(const SceneDescription& scene, double duration) {
    const bool allTakePart =
        std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyDescription& body) { return body.enabled; });
    if (!allTakePart) { return std::nullopt; }
    const PlacedScene placed = place(scene);
    if (auto form = freeFlight(scene, placed)) { return form; }
    if (auto form = bouncingBall(scene, placed)) { return form; }
    return pendulum(scene, placed, duration);
}

}  // namespace swept::measures
