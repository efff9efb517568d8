#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver_scene.h"

namespace swept::test {

/// Bodies and joints of a small scene over many steps. Anchors are kept in body coordinates; body 0 is the fixed world.
struct JointScene {
    SolverSettings settings{.dt = real(1.0 / 64), .subSteps = 4, .relaxPasses = 1};
    Vec2 gravity{0, 0};
    std::vector<SceneBody> bodies{SceneBody{}};
    struct Anchors {
        double ax = 0, ay = 0, bx = 0, by = 0;
    };
    std::vector<RevoluteConstraint> revolutes;
    std::vector<Anchors> revoluteAnchors;
    std::vector<DistanceConstraint> distances;
    std::vector<Anchors> distanceAnchors;
    SolverBatch batch;
    Solver solver;
    double largestGap = 0;    ///< of all revolutes, at ends of steps, metres
    double largestError = 0;  ///< of all distances
    int steps = 0;

    JointScene() { bodies[0].inertia = {}; }

    Real h() const { return settings.dt / static_cast<Real>(settings.subSteps); }
    BodySlot addBody(const SceneBody& body) {
        bodies.push_back(body);
        return static_cast<BodySlot>(bodies.size() - 1);
    }
    RevoluteConstraint& addRevolute(BodySlot a, BodySlot b, const Anchors& anchors) {
        RevoluteConstraint joint;
        joint.slotA = a;
        joint.slotB = b;
        joint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h());
        revolutes.push_back(joint);
        revoluteAnchors.push_back(anchors);
        return revolutes.back();
    }
    DistanceConstraint& addDistance(BodySlot a, BodySlot b, const Anchors& anchors) {
        DistanceConstraint joint;
        joint.slotA = a;
        joint.slotB = b;
        joint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h());
        distances.push_back(joint);
        distanceAnchors.push_back(anchors);
        return distances.back();
    }

    template <class Joint>
    void place(Joint& joint, const Anchors& anchors) {
        const SceneBody& a = bodies[joint.slotA];
        const SceneBody& b = bodies[joint.slotB];
        joint.anchorA = turned(a.angle, anchors.ax, anchors.ay);
        joint.anchorB = turned(b.angle, anchors.bx, anchors.by);
        joint.centerOffset = {real(b.x - a.x), real(b.y - a.y)};
    }

    void step() {
        batch.clear();
        for (std::size_t i = 1; i < bodies.size(); ++i) {
            bodies[i].drive = bodies[i].inertia.inverseMass > 0 ? driveOf(gravity, h()) : BodyDrive{};
            add(batch, bodies[i]);
        }
        for (std::size_t i = 0; i < revolutes.size(); ++i) {
            RevoluteConstraint joint = revolutes[i];
            place(joint, revoluteAnchors[i]);
            joint.baseAngle = real(bodies[joint.slotB].angle - bodies[joint.slotA].angle);
            joint.source = static_cast<std::uint32_t>(i);
            batch.revolutes.push_back(joint);
        }
        for (std::size_t i = 0; i < distances.size(); ++i) {
            DistanceConstraint joint = distances[i];
            place(joint, distanceAnchors[i]);
            joint.source = static_cast<std::uint32_t>(i);
            batch.distances.push_back(joint);
        }
        solver.solve(batch, settings);
        for (const RevoluteConstraint& joint : batch.revolutes) {
            const Real gap = anchorGap(joint, batch.states[joint.slotA], batch.states[joint.slotB]);
            largestGap = std::max(largestGap, static_cast<double>(gap));
            revolutes[joint.source] = joint;
        }
        for (const DistanceConstraint& joint : batch.distances) {
            const Real error = lengthError(joint, batch.states[joint.slotA], batch.states[joint.slotB]);
            largestError = std::max(largestError, static_cast<double>(error));
            distances[joint.source] = joint;
        }
        for (std::size_t i = 1; i < bodies.size(); ++i) { finishStep(bodies[i], batch.states[i]); }
        ++steps;
    }
    double time() const { return steps * static_cast<double>(settings.dt); }
};

/// Decaying oscillation seen at the ends of steps: period from the zero crossings, decay from the peaks.
class Oscillation {
public:
    void add(double time, double value) {
        if (count_ > 0 && (value > 0) != (last_ > 0)) {
            crossings_.push_back(lastTime_ + (time - lastTime_) * last_ / (last_ - value));
            peaks_.push_back(peak_);
            peak_ = 0;
        }
        peak_ = std::max(peak_, std::fabs(value));
        last_ = value;
        lastTime_ = time;
        ++count_;
    }
    std::size_t halfPeriods() const { return crossings_.empty() ? 0 : crossings_.size() - 1; }
    double angularFrequency() const {
        return std::acos(-1.0) * static_cast<double>(halfPeriods()) / (crossings_.back() - crossings_.front());
    }
    /// Rate (1/s) at which the peaks fall.
    double decayRate() const {
        const std::size_t n = peaks_.size() - 2;  // the first is cut off, the last is not complete
        return std::log(peaks_[1] / peaks_[1 + n]) / (static_cast<double>(n) * std::acos(-1.0) / angularFrequency());
    }

private:
    std::vector<double> crossings_;
    std::vector<double> peaks_;
    double peak_ = 0;
    double last_ = 0;
    double lastTime_ = 0;
    int count_ = 0;
};

/// What a sub-step makes of a spring, from the matrix of a step: (x, v) → (x + h·v₁, v₁), v₁ = (v − h·ω²·x)/D with
/// D = (1 + ζ·hω)² has determinant 1/D and trace 1 + (1 − (hω)²)/D; its eigenvalues are e^(−decay·h ± i·frequency·h).
struct SpringMotion {
    double angularFrequency = 0;
    double decayRate = 0;
};
inline SpringMotion discreteSpring(double omega, double zeta, double h) {
    const double root = 1 + zeta * h * omega;
    const double trace = 1 + (1 - h * omega * h * omega) / (root * root);
    return {std::acos(trace / 2 * root) / h, std::log(root) / h};
}

struct Momentum {
    double x = 0;
    double y = 0;
    double spin = 0;  ///< about the origin
};
inline Momentum momentumOf(const JointScene& scene) {
    Momentum sum;
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        const double mass = 1 / static_cast<double>(body.inertia.inverseMass);
        const double px = mass * static_cast<double>(body.state.velocity.x);
        const double py = mass * static_cast<double>(body.state.velocity.y);
        sum.x += px;
        sum.y += py;
        sum.spin += body.x * py - body.y * px +
                    static_cast<double>(body.state.angularVelocity) / static_cast<double>(body.inertia.inverseInertia);
    }
    return sum;
}

}  // namespace swept::test
