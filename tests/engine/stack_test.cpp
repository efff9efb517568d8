#include "world_support.h"

#include <cmath>
#include <string>

/// What stands must stand: penetration, drift and sag of piles of unit boxes over 10 s.

namespace swept::test {
namespace {

struct StackedPile {
    World world = makeWorld();
    std::vector<BodyId> boxes;
    std::vector<DVec2> places;
    double overlap = 0;  ///< deepest at the end of any step, m
    double drift = 0;    ///< farthest sideways at the end, m
    double sag = 0;      ///< farthest down at the end, m
    double turn = 0;     ///< largest angle at the end, rad

    StackedPile() { addStatic(world, box(50, 1), material(0.6), {0, -1}); }
    void add(DVec2 place, double density = 1) {
        places.push_back(place);
        boxes.push_back(addBody(world, dynamicAt(place), box(0.5, 0.5), material(0.6, 0, density)));
    }
    void stand(double seconds = 10) {
        for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
            must(world.step(kStep));
            overlap = std::max(overlap, deepestOverlap(world));
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const DVec2 moved = world.position(boxes[i]) - places[i];
            drift = std::max(drift, std::abs(moved.x));
            sag = std::max(sag, -moved.y);
            turn = std::max(turn, std::abs(world.angle(boxes[i])));
        }
    }
    void expect(const std::string& name, double overlapLimit, double driftLimit, double sagLimit) const {
        expectAtMost(name + "overlap", overlap, overlapLimit);
        expectAtMost(name + "drift", drift, driftLimit);
        expectAtMost(name + "sag", sag, sagLimit);
        expectAtMost(name + "turn", turn, driftLimit);
    }
};

TEST(Stack, TwentyBoxesStand) {
    StackedPile pile;
    for (int i = 0; i < 20; ++i) { pile.add({0, i + 0.5}); }
    pile.stand();
    pile.expect("", 0.002, 0.005, 0.01);
}

TEST(Stack, TwentyBoxesDroppedIntoPlaceStand) {
    StackedPile pile;
    for (int i = 0; i < 20; ++i) { pile.add({0.02 * (i % 2), 1.02 * i + 0.52}); }
    pile.stand();
    expectAtMost("overlap", pile.overlap, 0.005);
    expectAtMost("drift", pile.drift, 0.02);
    expectAtMost("turn", pile.turn, 0.002);
}

TEST(Stack, PyramidStands) {
    StackedPile pile;
    for (int row = 0; row < 10; ++row) {
        for (int i = 0; i < 10 - row; ++i) { pile.add({1.05 * (i - 0.5 * (9 - row)), row + 0.5}); }
    }
    pile.stand();
    pile.expect("", 0.001, 0.001, 0.002);
}

TEST(Stack, HeavyStandsOnLight) {
    for (const int below : {1, 10}) {
        StackedPile pile;
        for (int i = 0; i < below; ++i) { pile.add({0, i + 0.5}); }
        pile.add({0, below + 0.5}, 10);
        pile.stand();
        pile.expect("10:1 on " + std::to_string(below) + ": ", 0.002, 0.002, 0.001 * below);
    }
}

/// A block that is dropped on two columns side by side, which is no tower. (1000 kg sank into boxes of 1 kg by 2.2 cm,
/// 10 000 kg through them.)
TEST(Stack, HeavyDroppedOnTwoLightColumnsStands) {
    for (const int below : {1, 3, 6}) {
        for (const double ratio : {30.0, 1000.0, 1e5}) {
            for (const double drop : {0.01, 0.05, 0.3}) {
                World world = makeWorld();
                addStatic(world, box(20, 1), material(0.6), {0, -1});
                for (int i = 0; i < below; ++i) {
                    for (const double side : {-1.0, 1.0}) {
                        addBody(world, dynamicAt({side, i + 0.5 + (i + 1) * drop}), box(0.5, 0.5), material(0.6));
                    }
                }
                const double height = below + 0.5 + (below + 1) * drop;
                const BodyId block = addBody(world, dynamicAt({0, height}), box(2, 0.5), material(0.6, 0, ratio / 4));
                double lowest = height;
                for (int i = 0; i < 180; ++i) {
                    must(world.step(kStep));
                    lowest = std::min(lowest, world.position(block).y);
                }
                const std::string what = std::to_string(below) + " boxes high, " + std::to_string(ratio) + " : 1";
                expectAtMost(what + ", sinks in by", below + 0.5 - lowest, 5e-3);  // while it lands
                expectAtMost(what + ", at the end", std::abs(below + 0.5 - world.position(block).y), 1e-5);
            }
        }
    }
}

TEST(Stack, StackFarFromTheOriginStands) {
    World world = makeWorld();
    const DVec2 far{1e6, -1e6};
    addStatic(world, box(50, 1), material(0.6), far + DVec2{0, -1});
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) {
        boxes.push_back(addBody(world, dynamicAt(far + DVec2{0, i + 0.5}), box(0.5, 0.5), material(0.6)));
    }
    run(world, 600);
    const DVec2 top = world.position(boxes.back()) - far - DVec2{0, 9.5};
    expectAtMost("drift", std::abs(top.x), 0.002);
    expectAtMost("sag", std::abs(top.y), 0.005);
    expectAtMost("speed", length(velocityOf(world, boxes.back())), 1e-3);
}

/// What a column of equal bodies, each as high as `height`, does in 20 s with sleep.
struct Column {
    double asleep = 20;  ///< when all of them slept for the first time, s
    double overlap = 0;  ///< deepest, m
    double drift = 0;    ///< farthest sideways, m
    double sag = 0;      ///< farthest down, m
    double turn = 0;     ///< largest angle, rad
};

Column columnOf(const Polygon& polygon, double height, int count, double shift) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    addStatic(world, box(20, 1), material(0.6), {0, -1});
    std::vector<BodyId> bodies;
    std::vector<DVec2> places;
    for (int i = 0; i < count; ++i) {
        places.push_back({shift * (i % 2), height * (i + 0.5)});
        bodies.push_back(addBody(world, dynamicAt(places.back()), polygon, material(0.6)));
    }
    const auto sleeps = [&world](BodyId body) { return !world.isAwake(body); };
    Column column;
    for (int i = 0; i < static_cast<int>(20 * kRate); ++i) {
        must(world.step(kStep));
        column.overlap = std::max(column.overlap, deepestOverlap(world));
        if (std::all_of(bodies.begin(), bodies.end(), sleeps)) { column.asleep = std::min(column.asleep, i * kStep); }
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const DVec2 moved = world.position(bodies[i]) - places[i];
        column.drift = std::max(column.drift, std::abs(moved.x));
        column.sag = std::max(column.sag, -moved.y);
        column.turn = std::max(column.turn, std::abs(world.angle(bodies[i])));
    }
    return column;
}

/// Limits of the overlap and the sag as parts of the height of one body.
void expectRest(const std::string& name, const Polygon& polygon, double height, int count, double shift) {
    const Column column = columnOf(polygon, height, count, shift);
    const std::string of = name + " x " + std::to_string(count) + ", shift " + std::to_string(shift) + ": ";
    expectAtMost(of + "asleep", column.asleep, 4);
    expectAtMost(of + "overlap", column.overlap, height * 0.001 * count);
    expectAtMost(of + "drift", column.drift, 0.001);
    expectAtMost(of + "sag", column.sag, height * 0.01 * count);
    // A plank that sinks by a hundredth of its height at one end only has turned by so much: the stack of ten, each 1
    // cm farther out, comes to rest with a third of it.
    expectAtMost(of + "turn", column.turn, 5.4e-4);
}

/// Both ends of a plank push on each other through its turning, the more the wider it is.
TEST(Stack, PlanksComeToRest) {
    for (const double shift : {0.0, 0.01}) {
        expectRest("planks", box(1.85, 0.05), 0.1, 10, shift);
        expectRest("planks", box(1.85, 0.05), 0.1, 20, shift);
    }
}

/// Rounded shapes that stand exactly on each other, or hang over by a hair, have closest vertices and still two points.
TEST(Stack, RoundedBoxesAndCapsulesStand) {
    const Polygon rounded = must(makeBox(vec(0.2, 0.2), {}, 0, real(0.05)));
    for (const double shift : {0.0, 1e-7, 1e-4, 0.01}) {
        expectRest("rounded boxes", rounded, 0.5, 3, shift);
        expectRest("rounded boxes", rounded, 0.5, 15, shift);
        expectRest("capsules", capsule(0.5, 0.1), 0.2, 3, shift);
    }
}

/// Of what lies on ground, fixed or kinematic, both profiles leave little in it: in `fast`, whose contacts are springs,
/// the crate below carries 11 or 51 times its weight, and was 4 and 18 mm deep in the ground, where that was as soft as
/// another crate. (`giveOfSubStep` of four times the stiffness: 51 · 10 N · (1/240 s)² / (π/2)² kg⁻¹ is 3.6 mm with one
/// body that gives way.)
TEST(Stack, HeavyPressesLightLittleIntoTheGround) {
    for (const Profile profile : kProfiles) {
        for (const BodyType type : {BodyType::fixed, BodyType::kinematic}) {
            for (const double ratio : {10.0, 50.0}) {
                World world = makeWorld(profile);
                const BodyId ground = must(world.createBody(bodyAt(type, {0, -1})));
                must(world.addShape(ground, box(50, 1), material(0.6)));
                const BodyId below = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.6));
                addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5), material(0.6, 0, ratio));
                runFor(world, 5);
                const double give = (1 + ratio) * kGravity * (kStep / 4) * (kStep / 4) / (kPi * kPi / 4);
                expectAtMost(profileName(profile) + ", " + std::to_string(ratio) + " : 1",
                             0.5 - world.position(below).y, 1.25 * give);
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
