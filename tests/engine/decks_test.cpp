#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "world_support.h"

/// Dynamic bodies that are made of flush boxes are as smooth as those of one box: rafts, roofs of trains, ships.

namespace swept::test {
namespace {

constexpr int kPlanks = 20;

/// Planks of 1 m, side by side on a heavy body that lies on the ground.
BodyId addRaft(World& world, int planks = kPlanks) {
    const BodyId raft = must(world.createBody(dynamicAt({0, 0.25})));
    ShapeDef plank = material(0.6);
    plank.density = 500;
    for (int i = 0; i < planks; ++i) {
        must(world.addShape(raft, must(makeBox(vec(0.5, 0.25), vec(i - 9.5, 0))), plank));
    }
    return raft;
}

struct DeckRider {
    std::string name;
    Polygon shape;
    double height;  ///< of its centre over the deck, metres
};

std::vector<DeckRider> deckRiders() {
    return {{"box", box(0.25, 0.25), 0.25},
            {"thin box", box(0.05, 0.25), 0.25},
            {"ball", circle(0.2), 0.2},
            {"capsule", must(makeCapsule(vec(-0.2, 0), vec(0.2, 0), real(0.2))), 0.2}};
}

/// It goes without friction for 12 m.
void expectSmooth(World& world, BodyId rider, double speed, const std::string& name) {
    const double height = world.position(rider).y;
    double highest = 0;
    for (int i = 0; i < static_cast<int>(12 / speed / kStep); ++i) {
        must(world.step(kStep));
        highest = std::max(highest, world.position(rider).y - height);
    }
    expectAtMost(name + ", rises", highest, 1e-3);
    expectAtMost(name + ", lost of its speed", 1 - velocityOf(world, rider).x / speed, 2e-3);
}

/// (Of 25 to 182 of 200 such runs something was lost, up to all speed, and what rolled hopped by up to 1.3 m.)
TEST(Decks, NothingTripsOnTheirSeams) {
    for (const Profile profile : kProfiles) {
        for (const DeckRider& rider : deckRiders()) {
            for (int k = 0; k < 12; ++k) {
                const double speed = 2 + 0.9 * k;
                World world = makeWorld(profile);
                addStatic(world, box(60, 0.5), material(0.6), {0, -0.5});
                addRaft(world);
                const BodyId body = addBody(world, dynamicAt({-8 + 0.037 * k, 0.5 + rider.height}, vec(speed, 0)),
                                            rider.shape, material(0));
                expectSmooth(world, body, speed,
                             rider.name + ", " + profileName(profile) + ", " + std::to_string(speed) + " m/s");
            }
        }
    }
}

/// Pieces that come while something rides there, and a body that becomes dynamic with all of its own.
TEST(Decks, NorOnThoseOfWhatBecomesOne) {
    const std::vector<std::pair<std::string, std::function<void(World&, BodyId)>>> ways = {
        {"built under it",
         [](World& world, BodyId raft) {
             ShapeDef plank = material(0.6);
             plank.density = 500;
             for (int i = 4; i < kPlanks; ++i) {
                 must(world.addShape(raft, must(makeBox(vec(0.5, 0.25), vec(i - 9.5, 0))), plank));
             }
         }},
        {"static before", [](World& world, BodyId raft) {
             BodyDef def = world.definition(raft);
             def.type = BodyType::fixed;
             must(world.redefine(raft, def));
             run(world, 2);
             def = world.definition(raft);
             def.type = BodyType::dynamic;
             must(world.redefine(raft, def));
         }}};
    for (const auto& [name, change] : ways) {
        World world = makeWorld(Profile::accurate);
        addStatic(world, box(60, 0.5), material(0.6), {0, -0.5});
        const bool isBuilt = name == "built under it";
        const BodyId raft = addRaft(world, isBuilt ? 4 : kPlanks);
        const BodyId ball = addBody(world, dynamicAt({-8.5, 0.7}), circle(0.2), material(0));
        run(world, 5);
        change(world, raft);
        run(world, 1);
        must(world.setVelocity(ball, vec(5, 0), 0));
        expectSmooth(world, ball, 5, name);
    }
}

/// A pallet of flush boxes slides over round ground as one of a single box does.
TEST(Decks, TheySlideOverBumpsAsOnePiece) {
    for (const Profile profile : kProfiles) {
        double left[2] = {};
        for (const int planks : {1, 10}) {
            World world = makeWorld(profile);
            for (int i = 0; i < 40; ++i) { addStatic(world, circle(0.2), material(0), {0.4 * i, -0.2}); }
            const BodyId pallet = must(world.createBody(dynamicAt({2, 0.1}, vec(3, 0))));
            for (int i = 0; i < planks; ++i) {
                const double half = 1.0 / planks;
                const Polygon plank = must(makeBox(vec(half, 0.1), vec((2 * i + 1) * half - 1, 0)));
                must(world.addShape(pallet, plank, material(0)));
            }
            run(world, 120);
            left[planks == 1 ? 0 : 1] = velocityOf(world, pallet).x;
        }
        EXPECT_NEAR(left[1], left[0], 0.03) << profileName(profile);
        EXPECT_GT(left[0], 2.9) << profileName(profile);
    }
}

/// What is no seam stays in the way: a step of ten centimetres between two pieces.
TEST(Decks, StepsAreInTheWay) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        addStatic(world, box(60, 0.5), material(0.6), {0, -0.5});
        const BodyId raft = addRaft(world, 10);
        must(world.addShape(raft, must(makeBox(vec(0.5, 0.3), vec(0.5, 0.05)))));
        const BodyId rider = addBody(world, dynamicAt({-3, 0.75}, vec(3, 0)), box(0.25, 0.25), material(0));
        run(world, 120);
        EXPECT_LT(world.position(rider).x, 0) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test
