#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <swept/solver/direct/direct_parts.h>
#include <swept/solver/joint_islands/island_drive.h>
#include <swept/solver/joint_islands/joint_flow.h>
#include <swept/solver/joint_islands/joint_island_parts.h>
#include "../support/random.h"

namespace swept::test {

inline constexpr double kFlowStep = 1.0 / 64;
inline constexpr int kFlowSubSteps = 16;

inline DVec2 turnedBy(double angle, DVec2 v) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Bodies on joints of all kinds, each tied to one before it. Body 0 is the ground, which may move; or nothing is tied
/// to it. Nothing agrees with the joints but the places.
struct FlowTree {
    std::vector<IslandBody> bodies;
    std::vector<IslandHold> holds;
    std::vector<IslandBranch> branches;
    std::vector<IslandDrive> drives;
    std::vector<IslandHold> driven;    ///< by drive: its joint
    std::vector<DVec2> accelerations;  ///< by body, of constant forces
    std::vector<double> damping;       ///< 1/s
    int jointKinds[5] = {0, 0, 0, 0, 0};
    int driveKinds[4] = {0, 0, 0, 0};

    JointFlow::Island island() const { return {bodies, holds, branches, drives}; }

    explicit FlowTree(std::uint64_t seed, bool isDriven = false) {
        Random random(seed);
        const auto between = [&random](double low, double high) { return random.range(low, high); };
        const auto vector = [&between](double size) {
            const double x = between(-size, size);
            const double y = between(-size, size);
            return DVec2{x, y};
        };
        std::vector<DVec2> centres{{0, 0}};
        IslandBody ground;
        ground.column = kNoNode;
        if (seed % 3 == 0) {
            ground.velocity = vector(1);
            ground.spin = between(-1, 1);
        }
        bodies.push_back(ground);
        accelerations.push_back({});
        damping.push_back(0);
        const bool isFree = seed % 4 == 1;
        const int count = random.integer(1, 5);
        for (int i = 1; i <= count; ++i) {
            IslandBody body;
            body.column = static_cast<std::uint32_t>(i - 1);
            body.inverseMass = between(0.2, 5);
            body.inverseInertia = between(2, 50);
            body.velocity = vector(2);
            body.spin = between(-3, 3);
            const bool isDamped = random.integer(0, 3) == 0;
            damping.push_back(isDamped ? between(0.1, 5) : 0);
            accelerations.push_back(vector(10));
            const double h = kFlowStep / kFlowSubSteps;
            const double x = damping.back() * 0.5 * h;
            body.decay = body.angularDecay = std::exp(-x);
            body.gain = (isDamped ? -std::expm1(-x) / damping.back() : 0.5 * h) * accelerations.back();
            bodies.push_back(body);
            IslandBranch branch;
            branch.body = static_cast<std::uint32_t>(i);
            if (isFree && i == 1) {
                centres.push_back(vector(1));
                branches.push_back(branch);
                continue;
            }
            const int parent = random.integer(isFree ? 1 : 0, i - 1);
            branch.parent = parent == 0 ? IslandBranch::kNone : static_cast<std::uint32_t>(parent);
            centres.push_back(centres[static_cast<std::size_t>(parent)] + vector(1));
            const int kind = random.integer(0, 4);
            ++jointKinds[kind];
            const bool isB = random.integer(0, 1) == 1;
            const auto first = static_cast<std::uint32_t>(isB ? parent : i);
            const auto second = static_cast<std::uint32_t>(isB ? i : parent);
            const DVec2 at = centres.back() + vector(0.5);
            const DVec2 apart = DVec2{0.7, 0} + vector(0.3);  // short rods would whirl
            const auto add = [&](IslandHold::Kind of, DVec2 between_) {
                IslandHold hold;
                hold.kind = of;
                hold.count = of == IslandHold::Kind::point ? 2 : 1;
                hold.a = first;
                hold.b = second;
                hold.offset = centres[second] - centres[first];
                hold.anchorA = at - centres[first];
                hold.anchorB = at + between_ - centres[second];
                hold.axis = length(between_) > 0 ? between_ / length(between_) : DVec2{1, 0};
                hold.rest = of == IslandHold::Kind::rod ? length(between_) : 0;
                hold.size = norm(hold.anchorA) + norm(hold.anchorB) + norm(hold.offset);
                branch.holds[branch.holds[0] == IslandBranch::kNone ? 0 : 1] = static_cast<std::uint32_t>(holds.size());
                holds.push_back(hold);
            };
            switch (kind) {
                case 0:
                    add(IslandHold::Kind::point, {});
                    break;
                case 1:
                    add(IslandHold::Kind::rod, apart);
                    break;
                case 2:
                    add(IslandHold::Kind::side, apart);
                    break;
                case 3:
                    add(IslandHold::Kind::point, {});
                    add(IslandHold::Kind::angle, {});
                    break;
                default:
                    add(IslandHold::Kind::side, apart);
                    add(IslandHold::Kind::angle, {});
                    break;
            }
            branches.push_back(branch);
            if (!isDriven) { continue; }
            const auto drive = [&](IslandDrive::Way way) { addDrive(holds[branch.holds[0]], way, kind == 4, random); };
            if (kind == 2 || kind == 4) { drive(IslandDrive::Way::slide); }
            if (kind == 0 || kind == 2) { drive(IslandDrive::Way::turn); }
        }
    }

private:
    /// Of what moves its bodies.
    double leastOf(const IslandHold& hold, IslandDrive::Way way) const {
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : {hold.a, hold.b}) {
            const IslandBody& body = bodies[i];
            const double inverse = way == IslandDrive::Way::turn ? body.inverseInertia : body.inverseMass;
            if (inverse > 0) { least = std::min(least, 1 / inverse); }
        }
        return least;
    }
    /// A spring of a mass of its own, or with what its two bodies have; a motor that pushes, or holds a speed.
    void addDrive(IslandHold& hold, IslandDrive::Way way, bool holdsAngle, Random& random) {
        IslandDrive drive;
        drive.way = way;
        drive.holdsAngle = holdsAngle;
        const int kind = random.integer(0, 3);
        ++driveKinds[kind];
        if (kind == 0 || kind == 1) {
            drive.hasSpring = true;
            drive.place = way == IslandDrive::Way::turn ? random.range(-1.0, 1.0) : 0;
            drive.stiffness = random.range(1.0, 400.0);
            drive.damping = random.range(0.0, 10.0);
            drive.mass = random.range(0.3, 1.0) * leastOf(hold, way);
        }
        drive.springRate = std::max(std::sqrt(drive.stiffness), drive.damping);
        const IslandBody& a = bodies[hold.a];
        const IslandBody& b = bodies[hold.b];
        const bool isWheel = hold.kind == IslandHold::Kind::side && !drive.holdsAngle;
        if (kind == 1 && !(isWheel && way == IslandDrive::Way::turn)) {
            drive.inverseMass = a.inverseMass + b.inverseMass;
            drive.inverseInertiaOfA = a.inverseInertia;
            drive.inverseInertiaOfB = b.inverseInertia;
            if (isWheel) { drive.fixedStiffness = drive.stiffness * random.range(0.3, 1.0) * leastOf(hold, way); }
        }
        drive.most = std::numeric_limits<double>::infinity();
        if (kind == 2) {
            drive.motor = IslandDrive::Motor::pushes;
            drive.push = random.range(-2.0, 2.0);
            drive.speed = std::copysign(1000.0, drive.push);
        }
        if (kind == 3) {
            drive.motor = IslandDrive::Motor::holds;
            drive.speed = random.range(-2.0, 2.0);
        }
        if (hold.drives++ == 0) { hold.firstDrive = static_cast<std::uint32_t>(drives.size()); }
        drives.push_back(drive);
        driven.push_back(hold);
    }
};

}  // namespace swept::test
