#include "world_support.h"

/// Effort from an error budget: the error of the fixed worst case at a fraction of its cost, and a word when it is
/// missed.

namespace swept::test {
namespace {

/// What a run of a scene came to.
struct Outcome {
    double worst = 0;  ///< deepest penetration, or largest joint error, metres
    StepCounters sums;
    std::uint64_t mostSubSteps = 0;
    std::vector<double> numbers;  ///< poses at the end

    void count(const World& world) {
        const StepCounters& counters = world.counters();
        sums.bodySubSteps += counters.bodySubSteps;
        sums.overPenetration += counters.overPenetration;
        sums.overJointError += counters.overJointError;
        sums.bodiesAgain += counters.bodiesAgain;
        mostSubSteps = std::max(mostSubSteps, counters.mostSubSteps);
    }
};

/// By how much a world is larger and slower: powers of two.
struct Scale {
    double length = 1;
    double time = 1;
};

/// A pyramid stands for four seconds on a lift that goes up: it never rests, so that fixed sub-steps cost what they
/// cost all the time. Fifty times the weight of a box falls on it in the second one, and is taken away half a second
/// later.
class PyramidInBudget {
public:
    explicit PyramidInBudget(WorldSettings settings, Scale scale = {}) : scale_(scale) {
        settings.gravity = vec(0, -kGravity * scale.length / (scale.time * scale.time));
        settings.maxPenetration *= real(scale.length);
        world_ = makeWorld(settings);
        BodyDef lift = bodyAt(BodyType::kinematic, {0, -20 * scale.length});
        lift.velocity = vec(0, kLiftSpeed * scale.length / scale.time);
        addBody(world_, lift, boxOf(20), material(0.6));
        for (int row = 0; row < kRows; ++row) {
            const int columns = kRows + 1 - row;
            for (int i = 0; i < columns; ++i) { addBox({i - 0.5 * (columns - 1), row + 0.5}, 1); }
        }
    }

    Outcome play() {
        run(1);
        const BodyId weight = addBox({0, kRows + 0.9 + kLiftSpeed}, 50);
        run(0.5);
        must(world_.destroyBody(weight));
        boxes_.pop_back();
        run(2.5);
        for (const BodyId body : boxes_) {
            const DVec2 place = world_.position(body);
            outcome_.numbers.insert(outcome_.numbers.end(),
                                    {place.x / scale_.length, place.y / scale_.length, world_.angle(body)});
        }
        return outcome_;
    }

private:
    static constexpr int kRows = 5;
    static constexpr double kLiftSpeed = 0.25;  ///< m/s

    Polygon boxOf(double half) const { return box(half * scale_.length, half * scale_.length); }
    BodyId addBox(DVec2 place, double density) {
        boxes_.push_back(addBody(world_, dynamicAt(scale_.length * place), boxOf(0.5), material(0.6, 0, density)));
        return boxes_.back();
    }
    void run(double seconds) {
        for (int i = 0; i < static_cast<int>(std::lround(seconds * kRate)); ++i) {
            must(world_.step(kStep * scale_.time));
            outcome_.count(world_);
            world_.visitContacts([&](const ContactView& contact) {
                outcome_.worst = std::max(outcome_.worst, -static_cast<double>(contact.separation) / scale_.length);
            });
        }
    }

    Scale scale_;
    World world_;
    std::vector<BodyId> boxes_;
    Outcome outcome_;
};

WorldSettings withSubSteps(int subSteps) {
    WorldSettings settings = awakeSettings();
    settings.subSteps = subSteps;
    return settings;
}

WorldSettings withPenetration(double metres) {
    WorldSettings settings = awakeSettings();
    settings.maxPenetration = real(metres);
    return settings;
}

double costBeside(const Outcome& chosen, const Outcome& fixed) {
    return static_cast<double>(chosen.sums.bodySubSteps) / static_cast<double>(fixed.sums.bodySubSteps);
}

/// Whether a budget is kept all the time, for at most half of the smallest fixed cost that keeps it.
template <class Play>
void expectCheaperThanFixed(double budget, const Outcome& chosen, const Play& playFixed) {
    expectAtMost("error", chosen.worst, budget);
    EXPECT_EQ(chosen.sums.overPenetration, 0U);
    EXPECT_EQ(chosen.sums.overJointError, 0U);
    for (const int subSteps : {8, 16, 32, 64}) {
        const Outcome fixed = playFixed(subSteps);
        if (fixed.worst > budget) { continue; }
        expectAtMost("cost beside " + std::to_string(subSteps) + " sub-steps", costBeside(chosen, fixed), 0.5);
        EXPECT_GT(subSteps, 16) << "the scene is not demanding";
        return;
    }
    FAIL() << "no fixed number keeps it either";
}

TEST(Budget, ABlowKeepsThePenetrationOfTheWorstCaseAtAFractionOfItsCost) {
    for (const double budget : {1e-3, 2e-3}) {  // 16 sub-steps keep 3 mm
        SCOPED_TRACE(budget);
        expectCheaperThanFixed(budget, PyramidInBudget(withPenetration(budget)).play(),
                               [](int subSteps) { return PyramidInBudget(withSubSteps(subSteps)).play(); });
    }
}

TEST(Budget, FarInsideItCostsLessThanNone) {
    const Outcome usual = PyramidInBudget(awakeSettings()).play();
    const double budget = 0.0125;
    const Outcome chosen = PyramidInBudget(withPenetration(budget)).play();
    expectAtMost("penetration", chosen.worst, budget);
    expectAtMost("cost beside the profile's", costBeside(chosen, usual), 0.5);
}

TEST(Budget, OneThatCannotBeKeptIsReported) {
    const Outcome chosen = PyramidInBudget(withPenetration(2e-4)).play();
    EXPECT_GT(chosen.worst, 2e-4);
    EXPECT_GT(chosen.sums.overPenetration, 0U);
    EXPECT_EQ(chosen.mostSubSteps, 64U) << "no more than the cap";
}

TEST(Budget, DecidesTheSameInALargerAndSlowerWorld) {
    const Outcome one = PyramidInBudget(withPenetration(1e-3)).play();
    for (const Scale scale : {Scale{8, 1}, Scale{1.0 / 32, 0.5}, Scale{2, 4}}) {
        const Outcome other = PyramidInBudget(withPenetration(1e-3), scale).play();
        EXPECT_EQ(one.sums.bodySubSteps, other.sums.bodySubSteps) << scale.length;
        EXPECT_EQ(one.worst, other.worst) << scale.length;
        EXPECT_EQ(one.numbers, other.numbers) << scale.length;
    }
}

/// Ten rods, on hinges with limits, hang between two posts; a force pulls at the middle for a quarter of a second of
/// four, and damping lets what it does die away.
Outcome playRope(const WorldSettings& settings) {
    constexpr int kLinks = 10;
    World world = makeWorld(settings);
    BodyId last = must(world.createBody(bodyAt(BodyType::fixed, {0, 0})));
    std::vector<JointId> joints;
    const auto join = [&](BodyId a, BodyId b, DVec2 anchor) {
        RevoluteJointDef hinge;
        hinge.base.bodyA = a;
        hinge.base.bodyB = b;
        hinge.anchor = anchor;
        hinge.limits = AngleLimits{real(-3), real(3)};  // never met; without them nothing is iterated
        joints.push_back(must(world.createJoint(hinge)));
    };
    const DVec2 half{0.4, -0.3};  // down, then up again
    DVec2 end{0, 0};
    BodyId middle;
    for (int i = 0; i < kLinks; ++i) {
        const DVec2 along = i < kLinks / 2 ? half : DVec2{half.x, -half.y};
        ShapeDef shape;
        shape.filter.group = -1;
        BodyDef def = bodyAt(BodyType::dynamic, end + along, std::atan2(along.y, along.x));
        def.linearDamping = 3;
        const BodyId link = addBody(world, def, capsule(0.4, 0.2), shape);
        join(last, link, end);
        end += 2.0 * along;
        last = link;
        if (i == kLinks / 2) { middle = link; }
    }
    join(last, must(world.createBody(bodyAt(BodyType::fixed, end))), end);
    Outcome outcome;
    for (int i = 0; i < 4 * static_cast<int>(kRate); ++i) {
        if (i >= 60 && i < 75) { must(world.applyForce(middle, vec(0, -240), world.position(middle))); }
        must(world.step(kStep));
        outcome.count(world);
        for (const JointId id : joints) {
            outcome.worst = std::max(outcome.worst, static_cast<double>(world.jointError(id)));
        }
    }
    return outcome;
}

TEST(Budget, ARopeKeepsItsJointErrorAtAFractionOfTheCost) {
    for (const double budget : {2e-4, 1e-4}) {
        SCOPED_TRACE(budget);
        WorldSettings settings = awakeSettings();
        settings.maxJointError = real(budget);
        expectCheaperThanFixed(budget, playRope(settings),
                               [](int subSteps) { return playRope(withSubSteps(subSteps)); });
    }
}

TEST(Budget, WhatNoBudgetBoundsGetsNoWorse) {
    WorldSettings settings = awakeSettings();
    settings.maxPenetration = 1;  // the rope's joints have none
    EXPECT_EQ(playRope(settings).sums.bodySubSteps, playRope(awakeSettings()).sums.bodySubSteps);
    settings = withPenetration(std::numeric_limits<double>::infinity());
    settings.maxJointError = 1;  // the pyramid's contacts have none
    EXPECT_EQ(PyramidInBudget(settings).play().sums.bodySubSteps,
              PyramidInBudget(awakeSettings()).play().sums.bodySubSteps);
}

/// A ball between two walls two decimetres wider than it, without losses of energy.
struct RattleInBudget {
    double lost = 0;
    std::uint64_t over = 0;

    /// @param speed  m/s
    RattleInBudget(double speed, double maxLostTime) {
        WorldSettings settings = awakeSettings(0);
        settings.maxImpacts = 2;
        settings.maxLostTime = maxLostTime;
        World world = makeWorld(settings);
        for (const double side : {-1.0, 1.0}) { addStatic(world, box(0.5, 5), material(0, 1), {side * 0.65, 0}); }
        addBody(world, dynamicAt({0, 0}, vec(speed, 0)), circle(0.1), material(0, 1));
        for (int i = 0; i < 30; ++i) {
            must(world.step(kStep));
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
            over += world.counters().overLostTime;
        }
    }
};

TEST(Budget, LostTimeBuysMoreImpacts) {
    const double none = std::numeric_limits<double>::infinity();
    const RattleInBudget usual(30, none);
    EXPECT_GT(usual.lost, 0.1) << "five ways a step, and two impacts";
    EXPECT_EQ(usual.over, 0U) << "no budget, nothing to miss";
    const RattleInBudget kept(30, 0);
    EXPECT_EQ(kept.lost, 0);
    EXPECT_EQ(kept.over, 0U);
    const RattleInBudget some(30, 0.05);
    EXPECT_GT(some.lost, 0);
    EXPECT_LE(some.lost, 0.05);
    EXPECT_EQ(some.over, 0U);
    const RattleInBudget hopeless(600, 0);
    EXPECT_GT(hopeless.lost, 0);
    EXPECT_EQ(hopeless.over, 30U) << "a hundred ways a step, and 32 impacts";
}

}  // namespace
}  // namespace swept::test
