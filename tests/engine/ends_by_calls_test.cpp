#include <array>
#include <functional>
#include <vector>

#include "world_support.h"

/// Contacts that calls end between two steps, and whom events name after calls took it away.

namespace swept::test {
namespace {

/// A crate that stands on a box or on two segments of a chain.
struct OnFloor {
    World world = makeWorld();
    ShapeId floor, crateShape;
    BodyId crate;
    explicit OnFloor(bool isChain, bool isSensor = false) {
        const BodyId ground = must(world.createBody({}));
        ShapeDef def;
        def.sensor = isSensor;
        def.userData = 5;
        const std::array points{vec(10, 0), vec(0, 0), vec(-10, 0)};
        floor = isChain ? must(world.addChain(ground, points, false, def))
                        : must(world.addShape(ground, must(makeBox(vec(10, 0.5), vec(0, -0.5))), def));
        BodyDef body = dynamicAt({0, isSensor ? 0.4 : 0.5});
        body.gravityScale = isSensor ? 0 : 1;
        body.userData = 6;
        crate = must(world.createBody(body));
        crateShape = must(world.addShape(crate, box(0.5, 0.5)));
        run(world, 30);
    }
    std::vector<ContactEventType> step() {
        must(world.step(kStep));
        std::vector<ContactEventType> types;
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type != ContactEventType::hit) { types.push_back(event.type); }
        }
        return types;
    }
};

TEST(EndsByCalls, AreToldOfChainsAsOfOtherShapes) {
    const std::array<std::function<void(OnFloor&)>, 4> calls{
        [](OnFloor& s) { must(s.world.setPose(s.crate, s.world.position(s.crate), 0)); },
        [](OnFloor& s) {
            must(s.world.setPose(s.crate, s.world.position(s.crate) + DVec2{-3, 0}, 0));
        },
        [](OnFloor& s) {
            ShapeDef def = s.world.definition(s.crateShape);
            def.filter.category = 2;
            must(s.world.redefine(s.crateShape, def));
        },
        [](OnFloor& s) {
            ShapeDef def = s.world.definition(s.floor);
            def.filter.category = 2;
            must(s.world.redefine(s.floor, def));
        }};
    for (const bool isSensor : {false, true}) {
        const std::vector anew = isSensor ? std::vector{ContactEventType::sensorEnd, ContactEventType::sensorBegin}
                                          : std::vector{ContactEventType::end, ContactEventType::begin};
        for (const bool isChain : {false, true}) {
            OnFloor s(isChain, isSensor);
            EXPECT_TRUE(s.step().empty());
            for (std::size_t i = 0; i < calls.size(); ++i) {
                calls[i](s);
                EXPECT_EQ(s.step(), anew) << "chain " << isChain << ", sensor " << isSensor << ", call " << i;
                EXPECT_TRUE(s.step().empty()) << "chain " << isChain << ", sensor " << isSensor << ", call " << i;
            }
            must(s.world.setPose(s.crate, {0, 9}, 0));
            EXPECT_EQ(s.step(), std::vector{anew[0]}) << "chain " << isChain << ", sensor " << isSensor;
        }
    }
}

TEST(EndsByCalls, EventsTellUserDataOfWhatIsGone) {
    for (const bool isChain : {false, true}) {
        OnFloor s(isChain);
        const auto expectNamed = [&](const ContactEvent& event) {
            const bool isFloorA = event.shapeA == s.floor;
            EXPECT_EQ(isFloorA ? event.userDataA : event.userDataB, 5U);
            EXPECT_EQ(isFloorA ? event.userDataB : event.userDataA, 0U);
            EXPECT_EQ(isFloorA ? event.bodyUserDataB : event.bodyUserDataA, 6U);
            EXPECT_EQ(isFloorA ? event.bodyUserDataA : event.bodyUserDataB, 0U);
        };
        must(s.world.setPose(s.crate, {0, 2}, 0));
        int hits = 0;
        for (int i = 0; i < 60; ++i) {
            must(s.world.step(kStep));
            for (const ContactEvent& event : s.world.contactEvents()) {
                expectNamed(event);
                hits += event.type == ContactEventType::hit ? 1 : 0;
            }
        }
        EXPECT_GT(hits, 0);
        must(s.world.destroyBody(s.crate));
        must(s.world.step(kStep));
        ASSERT_EQ(s.world.contactEvents().size(), 1U);
        EXPECT_EQ(s.world.contactEvents()[0].type, ContactEventType::end);
        expectNamed(s.world.contactEvents()[0]);
    }
}

/// Within the step that destroyed nobody yet, and after.
TEST(EndsByCalls, SensorEventsTellUserData) {
    OnFloor s(false, true);
    must(s.world.setPose(s.crate, {0, 3}, 0));
    must(s.world.setVelocity(s.crate, vec(0, -400), 0));
    must(s.world.step(kStep));
    int passes = 0;
    for (const ContactEvent& event : s.world.contactEvents()) {
        EXPECT_EQ(event.shapeA, s.floor);
        EXPECT_EQ(event.userDataA, 5U);
        EXPECT_EQ(event.bodyUserDataB, 6U);
        passes += event.fraction > 0 ? 1 : 0;
    }
    EXPECT_EQ(passes, 2) << "it entered and left within the step";
}

}  // namespace
}  // namespace swept::test
