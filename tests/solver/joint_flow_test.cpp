#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <swept/solver/direct/direct_parts.h>
#include <swept/solver/joint_islands/joint_flow.h>
#include <swept/solver/joint_islands/joint_island_parts.h>
#include "../support/random.h"
#include "../support/some_of.h"

namespace swept::test {
namespace {

constexpr double kStep = 1.0 / 64;
constexpr int kSubSteps = 16;

DVec2 turned(double angle, DVec2 v) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Bodies on joints of all kinds, each tied to one before it. Body 0 is the ground, which may move; or nothing is tied
/// to it. Nothing agrees with the joints but the places.
struct Tree {
    std::vector<IslandBody> bodies;
    std::vector<IslandHold> holds;
    std::vector<IslandBranch> branches;
    std::vector<DVec2> accelerations;  ///< by body, of constant forces
    std::vector<double> damping;       ///< 1/s
    int jointKinds[5] = {0, 0, 0, 0, 0};

    explicit Tree(std::uint64_t seed) {
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
            const double h = kStep / kSubSteps;
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
        }
    }
};

/// The same by what joints demand alone: gaps, whose derivatives are differences, and one dense system.
class Oracle {
public:
    explicit Oracle(const Tree& tree) : tree_(tree) {
        for (const IslandBody& body : tree.bodies) {
            place_.insert(place_.end(), {0, 0, 0});
            velocity_.insert(velocity_.end(), {body.velocity.x, body.velocity.y, body.spin});
        }
        impulses_.resize(gaps(place_).size());
        agree();
        constexpr int kSteps = 32;
        for (int i = 0; i < kSteps; ++i) { step(kStep / kSteps); }
    }
    const std::vector<double>& place() const { return place_; }
    const std::vector<double>& velocity() const { return velocity_; }
    const std::vector<double>& impulses() const { return impulses_; }  ///< by row, with the first jerk

private:
    using Numbers = std::vector<double>;
    struct Change {
        Numbers acceleration;
        Numbers forces;
    };

    Numbers gaps(const Numbers& q) const {
        Numbers all;
        for (const IslandHold& hold : tree_.holds) {
            const std::size_t a = 3 * hold.a;
            const std::size_t b = 3 * hold.b;
            const DVec2 apart = hold.offset + DVec2{q[b] - q[a], q[b + 1] - q[a + 1]} + turned(q[b + 2], hold.anchorB) -
                                turned(q[a + 2], hold.anchorA);
            switch (hold.kind) {
                case IslandHold::Kind::point:
                    all.insert(all.end(), {apart.x, apart.y});
                    break;
                case IslandHold::Kind::rod:
                    all.push_back(length(apart) - hold.rest);
                    break;
                case IslandHold::Kind::side:
                    all.push_back(cross(turned(q[a + 2], hold.axis), apart));
                    break;
                case IslandHold::Kind::angle:
                    all.push_back(q[b + 2] - q[a + 2]);
                    break;
            }
        }
        return all;
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
    }

    const Tree& tree_;
    Numbers place_;
    Numbers velocity_;
    Numbers impulses_;
};

/// Hinges, rods, welds, sliders and wheels, on what is fixed, moves or flies free, damped or not; speeds that joints do
/// not allow are taken away first.
TEST(JointFlow, LeadsWhereJointsDemand) {
    int kinds[5] = {0, 0, 0, 0, 0};
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Tree tree(seed);
        for (std::size_t i = 0; i < 5; ++i) { kinds[i] += tree.jointKinds[i]; }
        const Oracle oracle(tree);
        JointFlow flow;
        flow.start(tree.bodies, tree.holds, tree.branches, kStep / kSubSteps);
        ASSERT_TRUE(flow.advance(kStep, 64, JointFlow::Tremor::followed)) << "seed " << seed;
        flow.finish(tree.bodies, tree.holds);
        constexpr double kNear = 2e-7;
        for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
            const IslandBody& body = tree.bodies[i];
            const std::string what = "seed " + std::to_string(seed) + ", body " + std::to_string(i);
            ASSERT_NEAR(body.place.position.x, oracle.place()[3 * i], kNear) << what;
            ASSERT_NEAR(body.place.position.y, oracle.place()[3 * i + 1], kNear) << what;
            ASSERT_NEAR(body.place.angle, oracle.place()[3 * i + 2], kNear) << what;
            ASSERT_NEAR(body.velocity.x, oracle.velocity()[3 * i], 30 * kNear) << what;
            ASSERT_NEAR(body.velocity.y, oracle.velocity()[3 * i + 1], 30 * kNear) << what;
            ASSERT_NEAR(body.spin, oracle.velocity()[3 * i + 2], 30 * kNear) << what;
        }
        std::size_t row = 0;
        for (const IslandHold& hold : tree.holds) {
            for (std::size_t i = 0; i < hold.count; ++i, ++row) {
                ASSERT_NEAR(hold.rows[i].total, oracle.impulses()[row], 30 * kNear)
                    << "seed " << seed << ", row " << row;
            }
        }
    }
    for (const int count : kinds) { EXPECT_GT(count, someOf(50)); }
}

}  // namespace
}  // namespace swept::test
