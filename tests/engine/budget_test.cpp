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
        mostSubSteps = std::max(mostSubSteps, counters.mostSubSteps);
    }
};

/// By how much a world is larger and slower: powers of two.
struct Scale {
    double length = 1;
    double time = 1;
};

/// A pyramid that stands for four seconds. Fifty times the weight of a box falls on it in the second one, and is taken
/// away half a second later.
class Pyramid {
public:
    explicit Pyramid(WorldSettings settings, Scale scale = {}) : scale_(scale) {
        settings.gravity = vec(0, -kGravity * scale.length / (scale.time * scale.time));
        settings.maxPenetration *= real(scale.length);
        world_ = makeWorld(settings);
        addStatic(world_, boxOf(20), material(0.6), {0, -20 * scale.length});
        for (int row = 0; row < kRows; ++row) {
            const int columns = kRows + 1 - row;
            for (int i = 0; i < columns; ++i) { addBox({i - 0.5 * (columns - 1), row + 0.5}, 1); }
        }
    }

    Outcome play() {
        run(1);
        const BodyId weight = addBox({0, kRows + 0.9}, 50);
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

TEST(Budget, ABlowKeepsThePenetrationOfTheWorstCaseAtAFractionOfItsCost) {
    // 2 mm was kept with a quarter to spare when a pyramid at rest was iterated. It is solved all at once now, and its
    // contacts carry without giving way: what the weight then presses them together by, when it rocks and iteration
    // takes over, comes within one step, and was 2.4 mm.
    const double budget = 2.75e-3;
    const Outcome fewer = Pyramid(withSubSteps(16)).play();
    const Outcome enough = Pyramid(withSubSteps(32)).play();
    const Outcome fixed = Pyramid(withSubSteps(64)).play();
    const Outcome chosen = Pyramid(withPenetration(budget)).play();
    EXPECT_GT(fewer.worst, budget) << "the worst case is easier than it was";
    EXPECT_LE(enough.worst, budget);
    // Scene and solver are symmetric but for rounding, which decides whether the weight comes down flat or rocks, and
    // comes down a second time on one edge, when few sub-steps seem enough. It did not when the limit was the budget
    // itself: which of the two it is changes with the order of a sum. A miss is short, and reported.
    expectAtMost("penetration", chosen.worst, 1.5 * budget);
    EXPECT_LE(chosen.sums.overPenetration, 8U);
    // Fixed numbers cost a quarter of what they did: at rest, an eighth of them will do.
    // 0.4 while rest cost as many sub-steps with 64 as without: settled islands are held in one, whoever asks for more.
    expectAtMost("cost beside 64 sub-steps", costBeside(chosen, fixed), 0.6);
    expectAtMost("cost beside 32 sub-steps", costBeside(chosen, enough), 0.75);
}

TEST(Budget, FarInsideItCostsLikeNone) {
    const Outcome usual = Pyramid(awakeSettings()).play();
    const double budget = 0.0125;
    const Outcome chosen = Pyramid(withPenetration(budget)).play();
    expectAtMost("penetration", chosen.worst, budget);
    // Most of the time it rests, which costs the least there is with and without budget. A limit of 1 was luck: what is
    // left is the time from the blow to rest, and how long a pyramid rocks on its edges, rounding decides (up to 1.08
    // in both precisions, as overlaps of a millionth were told from none here or there).
    expectAtMost("cost beside the profile's", costBeside(chosen, usual), 1.1);
}

TEST(Budget, OneThatCannotBeKeptIsReported) {
    const Outcome chosen = Pyramid(withPenetration(2e-4)).play();
    EXPECT_GT(chosen.worst, 2e-4);
    EXPECT_GT(chosen.sums.overPenetration, 0U);
    EXPECT_EQ(chosen.mostSubSteps, 64U) << "no more than the cap";
}

TEST(Budget, DecidesTheSameInALargerAndSlowerWorld) {
    const Outcome one = Pyramid(withPenetration(1e-3)).play();
    for (const Scale scale : {Scale{8, 1}, Scale{1.0 / 32, 0.5}, Scale{2, 4}}) {
        const Outcome other = Pyramid(withPenetration(1e-3), scale).play();
        EXPECT_EQ(one.sums.bodySubSteps, other.sums.bodySubSteps) << scale.length;
        EXPECT_EQ(one.worst, other.worst) << scale.length;
        EXPECT_EQ(one.numbers, other.numbers) << scale.length;
    }
}

/// Ten rods hang between two posts; a force pulls at the middle for half a second of four.
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
        joints.push_back(must(world.createJoint(hinge)));
    };
    const DVec2 half{0.4, -0.3};  // down, then up again
    DVec2 end{0, 0};
    BodyId middle;
    for (int i = 0; i < kLinks; ++i) {
        const DVec2 along = i < kLinks / 2 ? half : DVec2{half.x, -half.y};
        ShapeDef shape;
        shape.filter.group = -1;
        const BodyDef def = bodyAt(BodyType::dynamic, end + along, std::atan2(along.y, along.x));
        const BodyId link = addBody(world, def, capsule(0.4, 0.2), shape);
        join(last, link, end);
        end += 2.0 * along;
        last = link;
        if (i == kLinks / 2) { middle = link; }
    }
    join(last, must(world.createBody(bodyAt(BodyType::fixed, end))), end);
    Outcome outcome;
    for (int i = 0; i < 4 * static_cast<int>(kRate); ++i) {
        if (i >= 60 && i < 90) { must(world.applyForce(middle, vec(0, -60), world.position(middle))); }
        must(world.step(kStep));
        outcome.count(world);
        for (const JointId id : joints) {
            outcome.worst = std::max(outcome.worst, static_cast<double>(world.jointError(id)));
        }
    }
    return outcome;
}

TEST(Budget, ARopeKeepsItsJointErrorAtAFractionOfTheCost) {
    const double budget = 2e-4;
    const Outcome fewer = playRope(withSubSteps(16));
    const Outcome enough = playRope(withSubSteps(32));
    const Outcome fixed = playRope(withSubSteps(64));
    WorldSettings settings = awakeSettings();
    settings.maxJointError = real(budget);
    const Outcome chosen = playRope(settings);
    EXPECT_GT(fewer.worst, budget) << "the worst case is easier than it was";
    EXPECT_LE(enough.worst, budget);
    expectAtMost("joint error", chosen.worst, budget);
    EXPECT_EQ(chosen.sums.overJointError, 0U);
    expectAtMost("cost beside 64 sub-steps", costBeside(chosen, fixed), 0.4);
    expectAtMost("cost beside 32 sub-steps", costBeside(chosen, enough), 0.75);
}

TEST(Budget, WhatNoBudgetBoundsGetsNoWorse) {
    WorldSettings settings = awakeSettings();
    settings.maxPenetration = 1;  // the rope's joints have none
    EXPECT_EQ(playRope(settings).sums.bodySubSteps, playRope(awakeSettings()).sums.bodySubSteps);
    settings = withPenetration(std::numeric_limits<double>::infinity());
    settings.maxJointError = 1;  // the pyramid's contacts have none
    EXPECT_EQ(Pyramid(settings).play().sums.bodySubSteps, Pyramid(awakeSettings()).play().sums.bodySubSteps);
}

/// A ball between two walls two decimetres wider than it, without losses of energy.
struct Rattle {
    double lost = 0;
    std::uint64_t over = 0;

    /// @param speed  m/s
    Rattle(double speed, double maxLostTime) {
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
    const Rattle usual(30, none);
    EXPECT_GT(usual.lost, 0.1) << "five ways a step, and two impacts";
    EXPECT_EQ(usual.over, 0U) << "no budget, nothing to miss";
    const Rattle kept(30, 0);
    EXPECT_EQ(kept.lost, 0);
    EXPECT_EQ(kept.over, 0U);
    const Rattle some(30, 0.05);
    EXPECT_GT(some.lost, 0);
    EXPECT_LE(some.lost, 0.05);
    EXPECT_EQ(some.over, 0U);
    const Rattle hopeless(600, 0);
    EXPECT_GT(hopeless.lost, 0);
    EXPECT_EQ(hopeless.over, 30U) << "a hundred ways a step, and 32 impacts";
}

}  // namespace
}  // namespace swept::test
