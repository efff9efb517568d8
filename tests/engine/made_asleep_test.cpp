#include <functional>
#include <string>
#include <vector>

#include "world_support.h"

/// What is made asleep, or put to sleep where it was put, touches what is beside it, though no step moved it: that is
/// told, and what becomes of the one wakes the other.

namespace swept::test {
namespace {

constexpr int kPileBoxes = 5;

struct Pile {
    World world;
    BodyId level{};
    ShapeId floor{};
    std::vector<BodyId> boxes{};
};

/// A stack of boxes of 1 m on the floor. @param afterwards  it is made elsewhere, awake, and put to sleep in its place
Pile makePile(Profile profile, bool afterwards) {
    WorldSettings settings;
    settings.profile = profile;
    Pile pile{.world = makeWorld(settings)};
    pile.level = must(pile.world.createBody({}));
    pile.floor = must(pile.world.addShape(pile.level, must(makeBox(vec(20, 1), vec(0, -1)))));
    for (int i = 0; i < kPileBoxes; ++i) {
        BodyDef def = dynamicAt({afterwards ? 3.0 * i : 0.0, i + 0.5});
        def.awake = afterwards;
        pile.boxes.push_back(addBody(pile.world, def, box(0.5, 0.5)));
    }
    if (!afterwards) { return pile; }
    run(pile.world, 3);
    for (int i = 0; i < kPileBoxes; ++i) {
        must(pile.world.setPose(pile.boxes[static_cast<std::size_t>(i)], {0, i + 0.5}, 0));
    }
    for (const BodyId body : pile.boxes) { must(pile.world.setAwake(body, false)); }
    return pile;
}

int awakeIn(const Pile& pile) {
    int awake = 0;
    for (const BodyId body : pile.boxes) { awake += pile.world.isAwake(body) ? 1 : 0; }
    return awake;
}

int countEvents(const World& world, ContactEventType type) {
    int count = 0;
    for (const ContactEvent& event : world.contactEvents()) { count += event.type == type ? 1 : 0; }
    return count;
}

TEST(MadeAsleep, TellsWhatItTouchesAndSleepsOn) {
    for (const Profile profile : kProfiles) {
        for (const bool afterwards : {false, true}) {
            SCOPED_TRACE(profileName(profile) + (afterwards ? ", put there" : ", made there"));
            Pile pile = makePile(profile, afterwards);
            run(pile.world, 1);
            EXPECT_EQ(countEvents(pile.world, ContactEventType::begin), kPileBoxes);
            EXPECT_EQ(awakeIn(pile), 0);
            int points = 0;
            pile.world.visitContacts(pile.boxes[1], [&points](const ContactView&) { ++points; });
            EXPECT_EQ(points, 4) << "two below and two above it";
            for (int i = 0; i < 20; ++i) {
                run(pile.world, 1);
                EXPECT_TRUE(pile.world.contactEvents().empty());
                EXPECT_EQ(pile.world.counters().manifolds, 0U) << "no step looks at it again";
            }
            EXPECT_EQ(awakeIn(pile), 0);
            must(pile.world.setAwake(pile.boxes[0], true));
            for (int i = 0; i < 5; ++i) {
                run(pile.world, 1);
                EXPECT_TRUE(pile.world.contactEvents().empty()) << "nothing begins anew";
            }
            EXPECT_EQ(awakeIn(pile), kPileBoxes);
        }
    }
}

/// Whatever takes the support away lets all of it fall.
TEST(MadeAsleep, FallsWhenItsSupportGoes) {
    struct Change {
        std::string name;
        std::function<void(Pile&)> make;
    };
    const std::vector<Change> changes{
        {"floor destroyed", [](Pile& pile) { must(pile.world.destroyShape(pile.floor)); }},
        {"level destroyed", [](Pile& pile) { must(pile.world.destroyBody(pile.level)); }},
        {"level put elsewhere",
         [](Pile& pile) {
             must(pile.world.setPose(pile.level, {0, -5}, 0));
         }},
        {"level disabled", [](Pile& pile) { must(pile.world.setEnabled(pile.level, false)); }},
        {"floor filtered",
         [](Pile& pile) {
             ShapeDef def = pile.world.definition(pile.floor);
             def.filter.mask = 0;
             must(pile.world.redefine(pile.floor, def));
         }},
        {"lowest destroyed", [](Pile& pile) { must(pile.world.destroyBody(pile.boxes[0])); }},
        {"lowest put elsewhere",
         [](Pile& pile) {
             must(pile.world.setPose(pile.boxes[0], {9, 0.5}, 0));
         }},
    };
    for (const Profile profile : kProfiles) {
        for (const bool afterwards : {false, true}) {
            for (const Change& change : changes) {
                SCOPED_TRACE(profileName(profile) + (afterwards ? ", put there, " : ", made there, ") + change.name);
                Pile pile = makePile(profile, afterwards);
                run(pile.world, 3);
                change.make(pile);
                run(pile.world, 20);
                for (std::size_t i = 1; i < pile.boxes.size(); ++i) {
                    EXPECT_LT(pile.world.position(pile.boxes[i]).y, static_cast<double>(i) + 0.1) << "box " << i;
                }
            }
        }
    }
}

/// A static wall that is put a centimetre farther in each step pushes what sleeps, as it does what is awake.
TEST(MadeAsleep, IsPushedByAWallThatIsPutIntoIt) {
    for (const Profile profile : kProfiles) {
        SCOPED_TRACE(profileName(profile));
        Pile pile = makePile(profile, false);
        const BodyId wall = addStatic(pile.world, box(0.3, 0.9), {}, {-1, 1});
        for (int i = 0; i < 120; ++i) {
            must(pile.world.setPose(wall, {-1 + 0.01 * i, 1}, 0));
            run(pile.world, 1);
        }
        EXPECT_GT(pile.world.position(pile.boxes[0]).x, 0.9);
    }
}

}  // namespace
}  // namespace swept::test
