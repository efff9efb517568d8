#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "flow_tree.h"

namespace swept::test {

/// The same by what joints demand alone: gaps, whose derivatives are differences, and one dense system.
class FlowOracle {
public:
    explicit FlowOracle(const FlowTree& tree) : tree_(tree) {
        for (const IslandBody& body : tree.bodies) {
            place_.insert(place_.end(), {0, 0, 0});
            velocity_.insert(velocity_.end(), {body.velocity.x, body.velocity.y, body.spin});
        }
        impulses_.resize(gaps(place_).size());
        pushed_.resize(tree.drives.size());
        agree();
        constexpr int kSteps = 32;
        for (int i = 0; i < kSteps; ++i) { step(kFlowStep / kSteps); }
    }
    const std::vector<double>& place() const { return place_; }
    const std::vector<double>& velocity() const { return velocity_; }
    const std::vector<double>& impulses() const { return impulses_; }  ///< by row, with the first jerk
    const std::vector<double>& pushed() const { return pushed_; }      ///< impulses of springs and motors that push

private:
    using Numbers = std::vector<double>;
    struct Change {
        Numbers acceleration;
        Numbers forces;
        Numbers pushes{};  ///< of drives that hold nothing, by drive
    };

    Numbers gaps(const Numbers& q) const {
        Numbers all;
        for (const IslandHold& hold : tree_.holds) {
            const std::size_t a = 3 * hold.a;
            const std::size_t b = 3 * hold.b;
            const DVec2 apart = hold.offset + DVec2{q[b] - q[a], q[b + 1] - q[a + 1]} +
                                turnedBy(q[b + 2], hold.anchorB) - turnedBy(q[a + 2], hold.anchorA);
            switch (hold.kind) {
                case IslandHold::Kind::point:
                    all.insert(all.end(), {apart.x, apart.y});
                    break;
                case IslandHold::Kind::rod:
                    all.push_back(length(apart) - hold.rest);
                    break;
                case IslandHold::Kind::side:
                    all.push_back(cross(turnedBy(q[a + 2], hold.axis), apart));
                    break;
                case IslandHold::Kind::angle:
                    all.push_back(q[b + 2] - q[a + 2]);
                    break;
            }
        }
        for (std::size_t i = 0; i < tree_.drives.size(); ++i) {
            if (tree_.drives[i].motor == IslandDrive::Motor::holds) { all.push_back(placeOf(i, q)); }
        }
        return all;
    }
    double placeOf(std::size_t drive, const Numbers& q) const {
        const IslandHold& hold = tree_.driven[drive];
        const std::size_t a = 3 * hold.a;
        const std::size_t b = 3 * hold.b;
        if (tree_.drives[drive].way == IslandDrive::Way::turn) {
            return tree_.drives[drive].place + (q[b + 2] - q[a + 2]);
        }
        const DVec2 apart = hold.offset + DVec2{q[b] - q[a], q[b + 1] - q[a + 1]} + turnedBy(q[b + 2], hold.anchorB) -
                            turnedBy(q[a + 2], hold.anchorA);
        return dot(turnedBy(q[a + 2], hold.axis), apart);
    }
    /// What resists a spring: its force by the acceleration of the two bodies alone, of which the joint holds the rest.
    double massOf(std::size_t drive, const Numbers& q) const {
        const IslandHold& hold = tree_.driven[drive];
        const IslandBody& a = tree_.bodies[hold.a];
        const IslandBody& b = tree_.bodies[hold.b];
        const DVec2 armB = turnedBy(q[3 * hold.b + 2], hold.anchorB);
        const DVec2 armA =
            hold.offset + DVec2{q[3 * hold.b] - q[3 * hold.a], q[3 * hold.b + 1] - q[3 * hold.a + 1]} + armB;
        const DVec2 axis = turnedBy(q[3 * hold.a + 2], hold.axis);
        using Row = std::array<double, 6>;
        const auto along = [&](DVec2 d) { return Row{-d.x, -d.y, -cross(armA, d), d.x, d.y, cross(armB, d)}; };
        const Row turn{0, 0, -1, 0, 0, 1};
        std::vector<Row> rows;  // the driven one is the last
        if (tree_.drives[drive].way == IslandDrive::Way::turn) {
            rows = {along({1, 0}), along({0, 1}), turn};
        } else if (tree_.drives[drive].holdsAngle) {
            rows = {along({-axis.y, axis.x}), turn, along(axis)};
        } else {
            rows = {along({-axis.y, axis.x}), along(axis)};
        }
        const Row weights{a.inverseMass, a.inverseMass, a.inverseInertia,
                          b.inverseMass, b.inverseMass, b.inverseInertia};
        std::vector<Numbers> matrix(rows.size(), Numbers(rows.size()));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            for (std::size_t c = 0; c < rows.size(); ++c) {
                for (std::size_t i = 0; i < 6; ++i) { matrix[r][c] += rows[r][i] * weights[i] * rows[c][i]; }
            }
        }
        for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
            for (std::size_t r = k + 1; r < rows.size(); ++r) {
                const double factor = matrix[r][k] / matrix[k][k];
                for (std::size_t c = k; c < rows.size(); ++c) { matrix[r][c] -= factor * matrix[k][c]; }
            }
        }
        return 1 / matrix.back().back();
    }
    /// Along the way of a drive.
    double forceOf(std::size_t i, const Numbers& q, double speed) const {
        const IslandDrive& drive = tree_.drives[i];
        double force = drive.motor == IslandDrive::Motor::pushes ? drive.push : 0;
        if (drive.hasSpring) {
            const double mass = drive.inverseMass > 0 ? massOf(i, q) : drive.mass;
            force -= mass * (drive.stiffness * placeOf(i, q) + drive.damping * speed);
            force -= drive.fixedStiffness * placeOf(i, q);
        }
        return force;
    }
    /// Adds what they do to accelerations, by how their places change with each coordinate.
    Numbers addDrives(const Numbers& q, const Numbers& v, Numbers& driven) const {
        Numbers pushes;
        constexpr double kSmall = 1e-5;
        for (std::size_t drive = 0; drive < tree_.drives.size(); ++drive) {
            Numbers slope(q.size());
            double speed = 0;
            for (std::size_t i = 0; i < q.size(); ++i) {
                Numbers unit(q.size());
                unit[i] = 1;
                slope[i] =
                    (placeOf(drive, moved(q, kSmall, unit)) - placeOf(drive, moved(q, -kSmall, unit))) / (2 * kSmall);
                speed += slope[i] * v[i];
            }
            const double force = forceOf(drive, q, speed);
            for (std::size_t i = 0; i < q.size(); ++i) { driven[i] += inverseMass(i) * force * slope[i]; }
            pushes.push_back(force);
        }
        return pushes;
    }
    static Numbers moved(const Numbers& q, double factor, const Numbers& v) {
        Numbers sum = q;
        for (std::size_t i = 0; i < q.size(); ++i) { sum[i] += factor * v[i]; }
        return sum;
    }
    double inverseMass(std::size_t i) const {
        const IslandBody& body = tree_.bodies[i / 3];
        return i % 3 == 2 ? body.inverseInertia : body.inverseMass;
    }
    /// How gaps change with each coordinate.
    std::vector<Numbers> slopes(const Numbers& q) const {
        constexpr double kSmall = 1e-5;
        std::vector<Numbers> columns;
        for (std::size_t i = 0; i < q.size(); ++i) {
            Numbers unit(q.size());
            unit[i] = 1;
            const Numbers after = gaps(moved(q, kSmall, unit));
            const Numbers before = gaps(moved(q, -kSmall, unit));
            columns.push_back(moved(after, -1, before));
            for (double& each : columns.back()) { each /= 2 * kSmall; }
        }
        return columns;
    }
    /// Impulses that change the rows' speeds by so much, and how they change the velocities.
    Change answer(const Numbers& q, Numbers wanted) const {
        const std::vector<Numbers> columns = slopes(q);
        const std::size_t rows = wanted.size();
        std::vector<Numbers> matrix(rows, Numbers(rows));
        for (std::size_t r = 0; r < rows; ++r) {
            for (std::size_t c = 0; c < rows; ++c) {
                for (std::size_t i = 0; i < columns.size(); ++i) {
                    matrix[r][c] += columns[i][r] * inverseMass(i) * columns[i][c];
                }
            }
        }
        for (std::size_t k = 0; k < rows; ++k) {  // positive definite: no pivots
            for (std::size_t r = k + 1; r < rows; ++r) {
                const double factor = matrix[r][k] / matrix[k][k];
                for (std::size_t c = k; c < rows; ++c) { matrix[r][c] -= factor * matrix[k][c]; }
                wanted[r] -= factor * wanted[k];
            }
        }
        for (std::size_t k = rows; k-- > 0;) {
            for (std::size_t c = k + 1; c < rows; ++c) { wanted[k] -= matrix[k][c] * wanted[c]; }
            wanted[k] /= matrix[k][k];
        }
        Change change{Numbers(q.size()), wanted};
        for (std::size_t i = 0; i < q.size(); ++i) {
            for (std::size_t r = 0; r < rows; ++r) {
                change.acceleration[i] += inverseMass(i) * columns[i][r] * wanted[r];
            }
        }
        return change;
    }
    void agree() {
        const std::vector<Numbers> columns = slopes(place_);
        Numbers wanted(impulses_.size());
        for (std::size_t i = 0; i < place_.size(); ++i) { wanted = moved(wanted, -velocity_[i], columns[i]); }
        std::size_t row = 0;
        for (const IslandHold& hold : tree_.holds) { row += hold.count; }
        for (const IslandDrive& drive : tree_.drives) {
            if (drive.motor == IslandDrive::Motor::holds) { wanted[row++] += drive.speed; }
        }
        const Change change = answer(place_, wanted);
        velocity_ = moved(velocity_, 1, change.acceleration);
        impulses_ = change.forces;
    }
    Change changeAt(const Numbers& q, const Numbers& v) const {
        Numbers driven(q.size());
        for (std::size_t body = 1; body < tree_.bodies.size(); ++body) {
            driven[3 * body] = tree_.accelerations[body].x - tree_.damping[body] * v[3 * body];
            driven[3 * body + 1] = tree_.accelerations[body].y - tree_.damping[body] * v[3 * body + 1];
            driven[3 * body + 2] = -tree_.damping[body] * v[3 * body + 2];
        }
        const Numbers pushes = addDrives(q, v, driven);
        constexpr double kSmall = 1e-4;
        const std::vector<Numbers> columns = slopes(q);
        const Numbers after = gaps(moved(q, kSmall, v));
        const Numbers before = gaps(moved(q, -kSmall, v));
        const Numbers now = gaps(q);
        Numbers wanted(now.size());
        for (std::size_t r = 0; r < now.size(); ++r) {
            wanted[r] = -(after[r] + before[r] - 2 * now[r]) / (kSmall * kSmall);
            for (std::size_t i = 0; i < q.size(); ++i) { wanted[r] -= columns[i][r] * driven[i]; }
        }
        Change change = answer(q, wanted);
        change.acceleration = moved(change.acceleration, 1, driven);
        change.pushes = pushes;
        return change;
    }
    /// By the classical method of the fourth order.
    void step(double h) {
        const Numbers q = place_;
        const Numbers v = velocity_;
        const Change first = changeAt(q, v);
        const Numbers v2 = moved(v, h / 2, first.acceleration);
        const Change second = changeAt(moved(q, h / 2, v), v2);
        const Numbers v3 = moved(v, h / 2, second.acceleration);
        const Change third = changeAt(moved(q, h / 2, v2), v3);
        const Numbers v4 = moved(v, h, third.acceleration);
        const Change fourth = changeAt(moved(q, h, v3), v4);
        const auto add = [h](Numbers& to, const Numbers& k1, const Numbers& k2, const Numbers& k3, const Numbers& k4) {
            for (std::size_t i = 0; i < to.size(); ++i) { to[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]); }
        };
        add(place_, v, v2, v3, v4);
        add(velocity_, first.acceleration, second.acceleration, third.acceleration, fourth.acceleration);
        add(impulses_, first.forces, second.forces, third.forces, fourth.forces);
        add(pushed_, first.pushes, second.pushes, third.pushes, fourth.pushes);
    }

    const FlowTree& tree_;
    Numbers place_;
    Numbers velocity_;
    Numbers impulses_;
    Numbers pushed_;
};

}  // namespace swept::test
