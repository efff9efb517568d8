#include <numbers>

#include "../support/random.h"
#include "extreme_scenes.h"

/// Steps from 1 Hz to 10 kHz, and steps that vary: all stays finite and in its place, and no energy is made.

namespace swept::test {
namespace {

/// A stack, a ball that bounces, a pendulum and a chain, side by side.
struct Yard {
    World world = makeWorld();
    std::vector<BodyId> bodies;
    BodyId bob;
    double start = 0;

    explicit Yard(int boxes) {
        addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
        for (int i = 0; i < boxes; ++i) {
            bodies.push_back(addBody(world, dynamicAt({-5, i + 0.5}), box(0.5, 0.5), material(0.6)));
        }
        bodies.push_back(addBody(world, dynamicAt({0, 3}), circle(0.5), material(0.3, 0.5)));
        ShapeDef ghost;
        ghost.filter.mask = 0;
        BodyId before = addStatic(world, circle(0.02), ghost, {8, 5});
        bob = hang(before, {8, 5}, {9, 5}, ghost);
        before = addStatic(world, circle(0.02), ghost, {14, 5});
        for (int i = 0; i < 5; ++i) { before = hang(before, {14.0 + 0.4 * i, 5}, {14.4 + 0.4 * i, 5}, ghost); }
        start = energy();
    }
    BodyId hang(BodyId from, DVec2 anchor, DVec2 place, const ShapeDef& shape) {
        const BodyId body = addBody(world, dynamicAt(place), circle(0.1), shape);
        RevoluteJointDef hinge;
        hinge.base.bodyA = from;
        hinge.base.bodyB = body;
        hinge.anchor = anchor;
        must(world.createJoint(hinge));
        bodies.push_back(body);
        return body;
    }
    double energy() const { return energyOf(world, bodies, kGravity); }
    void expectSound(const std::string& when) const {
        for (const BodyId body : bodies) {
            const DVec2 p = world.position(body);
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(world.angle(body))) << when;
            ASSERT_GT(p.y, -0.1) << when;
            ASSERT_LT(std::abs(p.x), 20) << when;
        }
    }
    /// Of the hinge of the pendulum, metres.
    double gap() const { return std::abs(length(world.position(bob) - DVec2{8, 5}) - 1); }
};

/// @param gain  of energy that is allowed, as a part of what there is: what a step's own error makes of a swing
void expectGoesWell(const std::string& name, double seconds, double gain, double gap, const std::vector<double>& steps,
                    int boxes = 3) {
    Yard yard(boxes);
    double most = 0;
    double widest = 0;
    double time = 0;
    for (std::size_t i = 0; time < seconds; ++i) {
        const double dt = steps[i % steps.size()];
        must(yard.world.step(dt));
        time += dt;
        yard.expectSound(name + " step " + std::to_string(i));
        if (::testing::Test::HasFatalFailure()) { return; }
        most = std::max(most, yard.energy() / yard.start - 1);
        widest = std::max(widest, yard.gap());
    }
    expectAtMost(name + " energy gained", most, gain);
    expectAtMost(name + " gap", widest, gap);
}

TEST(StepSizes, OneHertz) { expectGoesWell("1 Hz", 300, 1e-6, 1e-6, {1.0}); }
TEST(StepSizes, TenKilohertz) { expectGoesWell("10 kHz", 0.25, kIsDouble ? 1e-12 : 1e-4, 1e-6, {1e-4}); }
TEST(StepSizes, FromCallToCall) {
    expectGoesWell("varied", 10, 5e-6, 1e-6, {1.0 / 60, 1.0 / 30, 1.0 / 240, 1.0 / 61, 0.05, 1e-3, 1.0 / 144});
}

/// In a step of 1 Hz a box of 1 m could fall 5 m, in one of five seconds 125 m: a stack that rests does not move.
TEST(StepSizes, StacksRestInStepsOfSeconds) {
    for (const double dt : {1.0, 5.0}) {
        Tower tower(10, 1);
        for (int i = 0; i < 60; ++i) { must(tower.world.step(dt)); }
        const std::string name = "steps of " + std::to_string(dt) + " s, ";
        expectAtMost(name + "sag", tower.sag(1), 1e-5);
        expectAtMost(name + "drift", tower.drift(), 1e-5);
    }
}

/// Boxes of many sizes that were dropped between two walls, each of those that are hinged to the one beside it, and
/// lie.
struct HeapInSteps {
    World world = makeWorld();
    std::vector<BodyId> boxes;

    HeapInSteps(Profile profile, bool hinged, std::uint64_t seed) {
        WorldSettings settings = world.settings();
        settings.profile = profile;
        settings.sleep = false;
        must(world.configure(settings));
        BodyId before = addStatic(world, box(20, 0.5));
        for (const double side : {-3.5, 3.5}) { addStatic(world, box(0.5, 20), {}, {side, 20}); }
        Random random(seed);
        for (int i = 0; i < 25; ++i) {
            const bool isFirst = i % 5 == 0;
            const double x = 1.2 * (i % 5) - 2.4;
            const double y = 1.2 * std::floor(i / 5) + 1.2;
            BodyDef def = dynamicAt({x + random.range(-0.05, 0.05), y});
            def.angle = random.range(-0.3, 0.3);
            const BodyId next = addBody(world, def, box(random.range(0.3, 0.5), random.range(0.3, 0.5)), material(0.6));
            if (hinged && !isFirst) {
                RevoluteJointDef hinge;
                hinge.base.bodyA = before;
                hinge.base.bodyB = next;
                hinge.anchor = {x - 0.6, y};
                must(world.createJoint(hinge));
            }
            boxes.push_back(before = next);
        }
        for (int i = 0; i < 300; ++i) { must(world.step(kStep)); }
    }
    double energy() const { return energyOf(world, boxes, kGravity); }
};

/// Overlaps that are held by steps of one length are not pushed out within a few that are shorter, or now and then are.
/// What remains is their slow way to the smaller ones of shorter steps: wedged by hinges, heaps rise by it.
TEST(StepSizes, ShorterThanTheOnesBefore) {
    Random random(20261125);
    std::vector<double> mixed;
    for (int i = 0; i < 97; ++i) { mixed.push_back(std::exp(random.range(std::log(1e-5), std::log(1.0 / 30)))); }
    const std::vector<std::vector<double>> rows = {{1e-3}, {1e-4}, {1e-5}, {kStep, 1e-4}, mixed};
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const bool hinged : {false, true}) {
            for (std::size_t row = 0; row < rows.size(); ++row) {
                const std::uint64_t seed = row + 1;
                HeapInSteps heap(profile, hinged, seed);
                const double start = heap.energy();
                double most = 0;
                for (std::size_t i = 0; i < 400; ++i) {
                    must(heap.world.step(rows[row][i % rows[row].size()]));
                    most = std::max(most, heap.energy() / start - 1);
                }
                expectAtMost("steps " + std::to_string(row) + (hinged ? ", hinged" : "") + " seed " +
                                 std::to_string(seed) + ", energy gained",
                             most, 0.01);
            }
        }
    }
}

/// Nor are they when the settings ask for more sub-steps: a tower, shaken a little so that nothing of it is held.
TEST(StepSizes, MoreSubStepsThanBefore) {
    for (const auto& [before, after] : {std::pair{4, 256}, {4, 16}, {16, 256}}) {
        WorldSettings settings = awakeSettings(Profile::fast);
        settings.subSteps = before;
        World world = makeWorld(settings);
        addStatic(world, box(50, 0.5), {}, {0, -0.5});
        std::vector<BodyId> boxes;
        for (int i = 0; i < 20; ++i) { boxes.push_back(addBody(world, dynamicAt({0, i + 0.5}), box(0.5, 0.5))); }
        double fastest = 0;
        for (int step = 0; step < 420; ++step) {
            if (step == 300) {
                settings.subSteps = after;
                must(world.configure(settings));
            }
            must(world.applyForce(boxes[3], vec(step % 2 == 0 ? 0.01 : -0.01, 0)));
            must(world.step(kStep));
            for (const BodyId body : boxes) {
                if (step >= 300) { fastest = std::max(fastest, length(velocityOf(world, body))); }
            }
        }
        expectAtMost(std::to_string(before) + " to " + std::to_string(after) + ", speed", fastest, 0.02);
    }
}

/// Lengths of steps that go up and down.
struct Rhythm {
    std::string name;
    double shortest, longest;  ///< s
    double period;             ///< s, of a sine; or 0: at random

    double stepAt(double time, Random& random) const {
        const double part = period > 0 ? 0.5 + 0.5 * std::sin(2 * std::numbers::pi * time / period) : random.uniform();
        return shortest + (longest - shortest) * part;
    }
};

const std::vector<Rhythm>& rhythms() {
    static const std::vector<Rhythm> kRhythms = {{"slow motion and back", 1.0 / 240, 1.0 / 60, 2.1},
                                                 {"slower", 1.0 / 240, 1.0 / 60, 4},
                                                 {"slowest", 1.0 / 240, 1.0 / 60, 10},
                                                 {"half as far", 1.0 / 144, 1.0 / 60, 2.1},
                                                 {"a tenth, twice a second", 1.0 / 66, 1.0 / 55, 0.5},
                                                 {"to long ones", 1.0 / 240, 1.0 / 20, 2.1},
                                                 {"a fifth, at random", 1.0 / 72, 1.0 / 48, 0},
                                                 {"four times, at random", 1.0 / 120, 1.0 / 30, 0}};
    return kRhythms;
}

/// @return seconds until all sleep, at most 40
double timeToSleep(World& world, const Rhythm& rhythm, Random& random) {
    double time = 0;
    for (bool isAnyAwake = true; isAnyAwake && time < 40;) {
        const double dt = rhythm.stepAt(time, random);
        must(world.step(dt));
        time += dt;
        isAnyAwake = false;
        world.visitBodies([&](BodyId body) { isAnyAwake = isAnyAwake || world.isAwake(body); });
    }
    return time;
}

World worldOnGround(Profile profile) {
    WorldSettings settings;
    settings.profile = profile;
    World world = makeWorld(settings);
    addStatic(world, box(20, 0.5), {}, {0, -0.5});
    return world;
}

/// Springs that gave way more in longer steps, and less in shorter ones, would pump the pile up and down: it would
/// never come to rest, and creep.
TEST(StepSizes, PilesSleepInStepsThatGoUpAndDown) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const Rhythm& rhythm : rhythms()) {
            for (const std::uint64_t seed : {1U, 2U}) {
                World world = worldOnGround(profile);
                for (const double side : {-8.0, 8.0}) { addStatic(world, box(0.5, 10), {}, {side, 10}); }
                Random random(seed);
                for (int i = 0; i < 60; ++i) {
                    addBody(world, dynamicAt({random.range(-6, 6), 1 + 0.6 * i}), box(0.3, 0.3));
                }
                expectAtMost(std::string(profile == Profile::fast ? "fast, " : "accurate, ") + rhythm.name + ", seed " +
                                 std::to_string(seed) + ", seconds until all sleep",
                             timeToSleep(world, rhythm, random), 20);
            }
        }
    }
}

/// Impulses of joints, too, become those of the new step: what started from too much or too little would swing.
TEST(StepSizes, ChainsSleepInStepsThatGoUpAndDown) {
    for (const bool areWelded : {false, true}) {
        for (const Rhythm& rhythm : rhythms()) {
            if (rhythm.longest > 1.0 / 40) { continue; }  // in `fast` they do not rest in steps of just that, either
            World world = worldOnGround(Profile::fast);
            BodyId before;
            for (int k = 0; k < 60; ++k) {
                const DVec2 place{0.5 * (k % 6) + 0.3 * std::floor(k / 6) - 10, 2 + 1.2 * std::floor(k / 6)};
                const BodyId next = addBody(world, dynamicAt(place), box(areWelded ? 0.2 : 0.25, 0.1));
                const JointDef base{.bodyA = before, .bodyB = next};
                const DVec2 anchor{place.x - 0.25, place.y};
                if (k % 6 > 0 && areWelded) { must(world.createJoint(WeldJointDef{.base = base, .anchor = anchor})); }
                if (k % 6 > 0 && !areWelded) {
                    must(world.createJoint(RevoluteJointDef{.base = base, .anchor = anchor}));
                }
                before = next;
            }
            Random random(1);
            expectAtMost(std::string(areWelded ? "welds, " : "hinges, ") + rhythm.name + ", seconds until all sleep",
                         timeToSleep(world, rhythm, random), 30);
        }
    }
}

/// A stack, or a heap, that fell asleep at 60 Hz, beside what drifts far away.
struct SleepingPile {
    World world;
    std::vector<BodyId> boxes;

    /// @param drifters  of many the contacts of the pile stay among those of what is awake
    SleepingPile(Profile profile, bool isHeap, int drifters) {
        if (isHeap) {
            HeapInSteps heap(profile, false, 1);
            world = heap.world;
            boxes = heap.boxes;
        } else {
            addStatic(world, box(20, 0.5));
            for (int i = 0; i < 12; ++i) { boxes.push_back(addBody(world, dynamicAt({0, 1.0 + i}), box(0.5, 0.5))); }
        }
        for (int i = 0; i < drifters; ++i) {
            BodyDef def = dynamicAt({1e3 + 3.0 * i, 50}, vec(0.5, 0));
            def.gravityScale = 0;
            addBody(world, def, circle(0.2));
        }
        WorldSettings settings = awakeSettings(profile);
        settings.sleep = true;
        must(world.configure(settings));
        for (int i = 0; i < 2000 && world.isAwake(boxes[0]); ++i) { must(world.step(kStep)); }
        EXPECT_FALSE(world.isAwake(boxes[0]));
    }
    /// Of the copy: sleeps through a step that is not as those before, and wakes.
    /// @return the highest speed within half a second, m/s
    double fastestAfter(double dt, int subSteps) const {
        World other = world;
        WorldSettings settings = other.settings();
        if (subSteps > 0) { settings.subSteps = subSteps; }
        must(other.configure(settings));
        must(other.step(dt));
        for (const BodyId body : boxes) { must(other.setAwake(body, true)); }
        double fastest = 0;
        for (int i = 0; i < std::min(300.0, 0.5 / dt); ++i) {
            must(other.step(dt));
            for (const BodyId body : boxes) { fastest = std::max(fastest, length(velocityOf(other, body))); }
        }
        return fastest;
    }
};

/// What slept while steps or sub-steps changed is carried when it wakes as it was before: no more, no less.
TEST(StepSizes, ChangeWhilePilesSleep) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const bool isHeap : {false, true}) {
            for (const int drifters : {0, 400}) {
                const SleepingPile pile(profile, isHeap, drifters);
                for (const auto& [dt, subSteps] : {std::pair{kStep, 0},
                                                   {kStep / 10, 0},
                                                   {1e-4, 0},
                                                   {4 * kStep, 0},
                                                   {kStep, 1},
                                                   {kStep, 64},
                                                   {kStep, 256}}) {
                    const std::string name = profileName(profile) + (isHeap ? " heap" : " stack") + " beside " +
                                             std::to_string(drifters) + ", then dt " + std::to_string(dt) +
                                             ", sub-steps " + std::to_string(subSteps);
                    expectAtMost(name + ", speed", pile.fastestAfter(dt, subSteps), 1e-3);
                }
            }
        }
    }
}

/// @return how deep a box that is made 0.2 m deep in the ground, beside a stack that has stood for seven seconds, still
/// is after six steps
double leftOfOverlap(Profile profile, double hitch) {
    World world = makeWorld(profile);
    addStatic(world, box(5, 0.5), {}, {0, -0.5});
    for (int i = 0; i < 8; ++i) { addBody(world, dynamicAt({0, i + 0.5}), box(0.5, 0.5)); }
    run(world, 180);
    must(world.step(hitch));
    run(world, 240);
    const BodyId late = addBody(world, dynamicAt({3, 0.3}), box(0.5, 0.5));
    run(world, 6);
    return 0.5 - world.position(late).y;
}

/// A single step that is much longer than all before it makes contacts no softer afterwards. (They closed overlaps as
/// slowly as in steps of that length for seconds: 6.3 cm of this one were left instead of 3.5 in `fast`.)
TEST(StepSizes, HitchesAreForgotten) {
    for (const Profile profile : kProfiles) {
        EXPECT_NEAR(leftOfOverlap(profile, 0.1), leftOfOverlap(profile, kStep), 1e-3) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test
