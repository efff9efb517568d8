#pragma once

#include "world_support.h"

/// Towers, chains and pendulums, as they are in `swept bench accuracy`.

namespace swept::test {

struct Tower {
    double gravity;
    World world;
    std::vector<BodyId> boxes;

    /// Boxes of side `side`, from the ground up; the last one of another density.
    Tower(int count, double side, double lastDensity = 1, double acceleration = kGravity)
        : gravity(acceleration), world(makeWorld(acceleration)) {
        addStatic(world, box(20 * side, 0.5 * side), material(0.6), {0, -0.5 * side});
        for (int i = 0; i < count; ++i) {
            boxes.push_back(addBody(world, dynamicAt({0, (i + 0.5) * side}), box(0.5 * side, 0.5 * side),
                                    material(0.6, 0, i + 1 < count ? 1 : lastDensity)));
        }
    }
    /// Loss of height of the top, as a part of it.
    double sag(double side) const {
        const double height = (static_cast<double>(boxes.size()) - 0.5) * side;
        return std::abs(height - world.position(boxes.back()).y) / height;
    }
    double drift() const {
        double farthest = 0;
        for (const BodyId body : boxes) { farthest = std::max(farthest, std::abs(world.position(body).x)); }
        return farthest;
    }
    double fastest() const {
        double speed = 0;
        for (const BodyId body : boxes) { speed = std::max(speed, length(velocityOf(world, body))); }
        return speed;
    }
};

/// Twenty links of 1 kg from a fixed pivot, then a ball.
struct Chain {
    static constexpr double kLink = 0.5;
    static constexpr double kLength = 20 * kLink + 0.5;
    enum class Ball { turns, doesNotTurn };
    World world = makeWorld();
    BodyId ball;

    Chain(double ratio, bool swung, Ball kind = Ball::turns) {
        const DVec2 along = swung ? DVec2{1, 0} : DVec2{0, -1};
        ShapeDef shape;
        shape.filter.group = -1;
        BodyId before = addStatic(world, circle(0.05), shape);
        const auto join = [&](BodyId next, double at) {
            RevoluteJointDef hinge;
            hinge.base.bodyA = before;
            hinge.base.bodyB = next;
            hinge.anchor = at * along;
            must(world.createJoint(hinge));
            before = next;
        };
        for (int i = 0; i < 20; ++i) {
            BodyDef def = dynamicAt(kLink * (i + 0.5) * along);
            def.angle = swung ? 0 : -kPi / 2;
            def.mass = real(1);
            join(addBody(world, def, box(0.25, 0.05), shape), kLink * i);
        }
        BodyDef def = dynamicAt(kLength * along);
        def.mass = real(ratio);
        def.fixedRotation = kind == Ball::doesNotTurn;
        ball = addBody(world, def, circle(0.5), shape);
        join(ball, kLink * 20);
    }
    /// Largest over some time.
    double stretch(double seconds) {
        double farthest = 0;
        for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
            must(world.step(kStep));
            farthest = std::max(farthest, length(world.position(ball)));
        }
        return std::max(farthest / kLength - 1, 0.0);
    }
};

/// Links of 1 kg from a fixed pivot, then a ball, let go at an angle above the level.
struct Swing {
    double gap = 0;  ///< widest of any joint at any time, m
    double stretch = 0;
    double lost = 0;  ///< of the energy, as a part of what it takes to lift the ball by the length
    double gained = 0;

    Swing(int links, double ratio, double angle, double seconds) {
        const double reach = 0.5 * links + 0.5;
        const DVec2 along{std::cos(angle), std::sin(angle)};
        World world = makeWorld();
        ShapeDef shape;
        shape.filter.group = -1;
        BodyId before = addStatic(world, circle(0.05), shape);
        std::vector<BodyId> bodies;
        std::vector<JointId> joints;
        for (int i = 0; i <= links; ++i) {
            const bool isBall = i == links;
            BodyDef def = dynamicAt((0.5 * i + (isBall ? 0.5 : 0.25)) * along);
            def.angle = angle;
            def.mass = real(isBall ? ratio : 1);
            bodies.push_back(addBody(world, def, isBall ? circle(0.5) : box(0.25, 0.05), shape));
            RevoluteJointDef hinge;
            hinge.base.bodyA = before;
            hinge.base.bodyB = before = bodies.back();
            hinge.anchor = 0.5 * i * along;
            joints.push_back(must(world.createJoint(hinge)));
        }
        const double start = energyOf(world, bodies, kGravity);
        const double scale = ratio * kGravity * reach;
        for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
            must(world.step(kStep));
            const double change = (energyOf(world, bodies, kGravity) - start) / scale;
            lost = std::max(lost, -change);
            gained = std::max(gained, change);
            stretch = std::max(stretch, length(world.position(before)) / reach - 1);
            for (const JointId joint : joints) { gap = std::max(gap, static_cast<double>(world.jointError(joint))); }
        }
    }
};

/// A disk on a hinge 1 m from its centre, let go at an angle from the vertical.
struct Pendulum {
    World world = makeWorld();
    BodyId bob;
    double start = 0;

    explicit Pendulum(double degrees) {
        ShapeDef none;
        none.filter.mask = 0;
        const BodyId pivot = addStatic(world, circle(0.02), none);
        const double angle = degrees * kPi / 180;
        bob = addBody(world, dynamicAt({std::sin(angle), -std::cos(angle)}), circle(0.1), none);
        RevoluteJointDef hinge;
        hinge.base.bodyA = pivot;
        hinge.base.bodyB = bob;
        must(world.createJoint(hinge));
        start = energy();
    }
    double energy() const {
        const BodyId bodies[] = {bob};
        return energyOf(world, bodies, kGravity);
    }
    /// As a part of what it takes to lift the bob by 1 m.
    double energyError() const { return std::abs(energy() - start) / (world.mass(bob) * kGravity); }
    double gap() const { return std::abs(length(world.position(bob)) - 1); }
};

}  // namespace swept::test
