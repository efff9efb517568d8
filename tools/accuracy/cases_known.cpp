#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <swept/samples/scene_geometry.h>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;
using build::hinge;

constexpr double kOneDegree = std::numbers::pi / 180;

Case projectile() {
    Case c{"known", "projectile", emptyScene("projectile"), 120, {}, {}, false};
    addDynamic(c.scene, "ball", {0, 0}, {circle(0.5)}).velocity = {7, 11};
    c.measures = {{"place", "m", [](const Frames& frames) {
                       const double t = frames.back().time;
                       const DVec2 exact{7 * t, 11 * t - 0.5 * kGravity * t * t};
                       return length(bodyAt(frames.back(), 0).position - exact);
                   }}};
    return c;
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
double ellipticK(double k) {
    double a = 1;
    double b = std::sqrt(1 - k * k);
    for (int i = 0; i < 60 && a != b; ++i) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return std::numbers::pi / (2 * a);
}

/// Kinetic and potential energy of some bodies, J.
struct Weights {
    std::vector<MassAndInertia> bodies;
    double energy(const Frame& frame) const {
        double sum = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const BodyFrame& body = frame.bodies[i];
            sum += bodies[i].mass * (0.5 * dot(body.velocity, body.velocity) + kGravity * body.position.y) +
                   0.5 * bodies[i].inertia * body.angularVelocity * body.angularVelocity;
        }
        return sum;
    }
};
Weights weightsOf(const SceneDescription& scene) {
    Weights weights;
    for (const BodyDescription& body : scene.bodies) {
        weights.bodies.push_back(body.type == SceneBodyType::dynamic ? massOfShapes(body) : MassAndInertia{});
    }
    return weights;
}

/// Change of the energy from start to end, as a part of `scale`.
Measure energyDrift(const SceneDescription& scene, double scale) {
    return {"energy", "1", [weights = weightsOf(scene), scale](const Frames& frames) {
                return std::fabs(weights.energy(frames.back()) - weights.energy(frames.front())) / scale;
            }};
}

/// A disk on a hinge 1 m above its centre, let go at an angle from the vertical; 60 s.
Case pendulum(double degrees) {
    const std::string name = "pendulum-" + std::to_string(static_cast<int>(degrees));
    Case c{"known", name, emptyScene(name), 3600, {}, {}, false};
    constexpr double kRadius = 0.1;
    const double start = degrees * kOneDegree;
    addFixed(c.scene, "pivot", {0, 0}, {circle(0.02)}).shapes[0].filter.mask = 0;
    addDynamic(c.scene, "bob", {std::sin(start), -std::cos(start)}, {circle(kRadius)});
    hinge(c.scene, "pivot", "bob", {0, 0});
    const MassAndInertia bob = massOfShapes(c.scene.bodies[1]);
    const double exact =
        4 * ellipticK(std::sin(start / 2)) * std::sqrt((bob.inertia + bob.mass) / (bob.mass * kGravity));
    const auto period = [exact](const Frames& frames) {
        // Times at which the bob passes the vertical, between frames by a straight line.
        double first = -1;
        double last = -1;
        int passes = 0;
        for (std::size_t i = 1; i < frames.size(); ++i) {
            const double a = bodyAt(frames[i - 1], 1).position.x;
            const double b = bodyAt(frames[i], 1).position.x;
            if ((a > 0) != (b > 0) && bodyAt(frames[i], 1).position.y < 0) {
                last = frames[i - 1].time + (frames[i].time - frames[i - 1].time) * a / (a - b);
                first = first < 0 ? last : first;
                ++passes;
            }
        }
        return passes < 2 ? 1 : std::fabs(2 * (last - first) / (passes - 1) / exact - 1);
    };
    const auto gap = [](const Frames& frames) {
        double worst = 0;
        for (const Frame& frame : frames) { worst = std::max(worst, std::fabs(length(bodyAt(frame, 1).position) - 1)); }
        return worst;
    };
    c.measures = {energyDrift(c.scene, bob.mass * kGravity), {"period", "1", period}, {"joint gap", "m", gap}};
    return c;
}

/// Two rods of 1 by 0.1 m, let go level.
Case doublePendulum() {
    Case c{"known", "double-pendulum", emptyScene("double-pendulum"), 1800, {}, {}, false};
    addFixed(c.scene, "pivot", {0, 0}, {circle(0.02)}).shapes[0].filter.mask = 0;
    for (int i = 0; i < 2; ++i) {
        const std::string name = i == 0 ? "upper" : "lower";
        addDynamic(c.scene, name, {0.5 + i, 0}, {box({0.5, 0.05})}).shapes[0].filter.mask = 0;
        hinge(c.scene, i == 0 ? "pivot" : "upper", name, {static_cast<double>(i), 0});
    }
    c.measures = {energyDrift(c.scene, 0.1 * kGravity * 2)};
    return c;
}

Case freeSpin(double omega) {
    const std::string name = "spin-" + std::to_string(static_cast<int>(omega));
    Case c{"known", name, emptyScene(name, 0), 600, {}, {}, false};
    addDynamic(c.scene, "bar", {0, 0}, {box({0.5, 0.05})}).angularVelocity = omega;
    c.measures = {{"angle", "1", [omega](const Frames& frames) {
                       return std::fabs(bodyAt(frames.back(), 0).angle / (omega * frames.back().time) - 1);
                   }}};
    return c;
}

/// A hundred disks in a box, e = 1: their energy after 20 s.
Case gas() {
    Case c{"known", "gas", emptyScene("gas", 0), 1200, {}, {}, false};
    addFixed(c.scene, "walls", {0, 0},
             {build::segment({-5, -5}, {5, -5}), build::segment({5, -5}, {5, 5}), build::segment({5, 5}, {-5, 5}),
              build::segment({-5, 5}, {-5, -5})});
    build::Dice dice(7);
    for (int i = 0; i < 100; ++i) {
        // Sums of twelve uniform numbers: as good as a normal distribution here.
        DVec2 velocity{-30, -30};
        for (int k = 0; k < 12; ++k) { velocity += DVec2{dice.range(0, 5), dice.range(0, 5)}; }
        addDynamic(c.scene, "", {0.9 * (i % 10 - 4.5), 0.9 * (i / 10 - 4.5)}, {circle(0.2)}).velocity = velocity;
    }
    setSurface(c.scene, 0, 1);
    const Weights weights = weightsOf(c.scene);
    c.measures = {{"energy", "1", [weights](const Frames& frames) {
                       const auto kinetic = [&](const Frame& frame) {
                           double sum = 0;
                           for (std::size_t i = 0; i < weights.bodies.size(); ++i) {
                               sum += weights.bodies[i].mass * dot(frame.bodies[i].velocity, frame.bodies[i].velocity);
                           }
                           return sum;
                       };
                       return std::fabs(kinetic(frames.back()) / kinetic(frames.front()) - 1);
                   }}};
    c.verdict = staysWithin(5);
    return c;
}

/// Five balls in a row, the first one comes at 5 m/s: what the last one lacks of it.
Case cradle(const std::string& name, double gap) {
    Case c{"known", name, emptyScene(name, 0), 180, {}, {}, false};
    addDynamic(c.scene, "", {-1.5, 0}, {circle(0.2)}).velocity = {5, 0};
    for (int i = 0; i < 4; ++i) { addDynamic(c.scene, "", {i * (0.4 + gap), 0}, {circle(0.2)}); }
    setSurface(c.scene, 0, 1);
    c.measures = {{"last ball", "1",
                   [](const Frames& frames) { return std::fabs(bodyAt(frames.back(), 4).velocity.x / 5 - 1); }}};
    return c;
}

/// Five pendulums of 5 m whose balls touch, the first one let go at 45°: energy.
Case pendulumCradle() {
    Case c{"known", "cradle-pendulums", emptyScene("cradle-pendulums"), 600, {}, {}, false};
    constexpr double kLength = 5;
    constexpr double kRadius = 0.2;
    const double start = -45 * kOneDegree;
    for (int i = 0; i < 5; ++i) {
        const std::string ball = "ball" + std::to_string(i);
        const DVec2 top{2 * kRadius * i, kLength};
        const double angle = i == 0 ? start : 0;
        addDynamic(c.scene, ball, top + DVec2{kLength * std::sin(angle), -kLength * std::cos(angle)},
                   {circle(kRadius)});
        addFixed(c.scene, "pivot" + std::to_string(i), top, {circle(0.02)}).shapes[0].filter.mask = 0;
        hinge(c.scene, "pivot" + std::to_string(i), ball, top);
    }
    setSurface(c.scene, 0, 1);
    const double lifted = kRadius * kRadius * std::numbers::pi * kGravity * kLength * (1 - std::cos(start));
    c.measures = {energyDrift(c.scene, lifted)};
    return c;
}

/// Fifty disks, of four times the density, and fifty squares fly at each other, e = μ = 0.5, nothing else around: what
/// changes of the momentum and of the angular momentum, as a part of what the bodies have without signs.
Case cluster() {
    Case c{"known", "cluster", emptyScene("cluster", 0), 600, {}, {}, false};
    build::Dice dice(11);
    for (int i = 0; i < 100; ++i) {
        const DVec2 place{1.1 * (i % 10 - 4.5), 1.1 * (i / 10 - 4.5)};
        const auto shape = i % 2 == 0 ? build::withDensity(circle(0.4), 4) : box({0.4, 0.4});
        BodyDescription& body = addDynamic(c.scene, "", place, {shape});
        body.velocity = -0.5 * place + DVec2{dice.range(-2, 2), dice.range(-2, 2)};
        body.angularVelocity = dice.range(-5, 5);
    }
    setSurface(c.scene, 0.5, 0.5);
    const Weights weights = weightsOf(c.scene);
    const auto change = [weights](const Frames& frames, bool angular) {
        DVec2 sum;
        double turning = 0;
        double scale = 0;
        for (const auto& [frame, sign] : {std::pair{&frames.back(), 1.0}, std::pair{&frames.front(), -1.0}}) {
            for (std::size_t i = 0; i < weights.bodies.size(); ++i) {
                const BodyFrame& body = frame->bodies[i];
                const DVec2 momentum = weights.bodies[i].mass * body.velocity;
                const double spin = cross(body.position, momentum) + weights.bodies[i].inertia * body.angularVelocity;
                sum += sign * momentum;
                turning += sign * spin;
                if (sign < 0) { scale += angular ? std::fabs(spin) : length(momentum); }
            }
        }
        return (angular ? std::fabs(turning) : length(sum)) / scale;
    };
    c.measures = {{"momentum", "1", [change](const Frames& frames) { return change(frames, false); }},
                  {"angular momentum", "1", [change](const Frames& frames) { return change(frames, true); }}};
    return c;
}

}  // namespace

std::vector<Case> knownCases() {
    std::vector<Case> cases = slopeCases();
    for (Case& known : std::vector<Case>{projectile(), pendulum(90), pendulum(170), doublePendulum(), freeSpin(10),
                                         freeSpin(100), freeSpin(500), gas(), cradle("cradle", 0),
                                         cradle("cradle-gaps", 0.01), pendulumCradle(), cluster()}) {
        cases.push_back(std::move(known));
    }
    return cases;
}

}  // namespace swept::accuracy
