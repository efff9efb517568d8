#include "world_support.h"

/// What is still and in balance is held: not moved, not looked at, and part of the world again as soon as anything
/// concerns it.

namespace swept::test {
namespace {

WorldSettings settingsOf(Profile profile) {
    WorldSettings settings = awakeSettings(profile);
    return settings;
}

/// A small pyramid that has come to rest.
struct Pile {
    World world;
    BodyId ground;
    std::vector<BodyId> boxes;  ///< from below, row by row

    explicit Pile(const WorldSettings& settings, double seconds = 4) : world(makeWorld(settings)) {
        ground = addStatic(world, box(10, 0.5), material(0.6), {0, -0.5});
        for (int row = 0; row < 4; ++row) {
            for (int i = 0; i < 4 - row; ++i) {
                const DVec2 place{1.05 * (i - 0.5 * (3 - row)), row + 0.5};
                boxes.push_back(addBody(world, dynamicAt(place), box(0.5, 0.5), material(0.6)));
            }
        }
        runFor(world, seconds);
    }
    explicit Pile(Profile profile) : Pile(settingsOf(profile)) {}

    /// Too weakly to move it, but then it is not held.
    void nudge() { must(world.applyForce(boxes[0], vec(1e-9, 0), world.centerOfMass(boxes[0]))); }
    bool isHeld() const { return world.counters().settledBodies >= boxes.size(); }
    /// Farthest of any from where it was, metres.
    double moveSince(const std::vector<DVec2>& before) const {
        double farthest = 0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            farthest = std::max(farthest, length(world.position(boxes[i]) - before[i]));
        }
        return farthest;
    }
    std::vector<DVec2> places() const {
        std::vector<DVec2> places;
        for (const BodyId id : boxes) { places.push_back(world.position(id)); }
        return places;
    }
};

TEST(Held, StaysToTheBitAndCostsNothing) {
    for (const Profile profile : kProfiles) {
        Pile pile(profile);
        ASSERT_TRUE(pile.isHeld());
        const std::vector<DVec2> before = pile.places();
        const std::uint64_t touching = pile.world.counters().touching;
        runFor(pile.world, 60);
        EXPECT_EQ(pile.moveSince(before), 0);
        const StepCounters& counters = pile.world.counters();
        EXPECT_EQ(counters.solvedBodies + counters.manifolds + counters.constraints + counters.subSteps, 0U);
        EXPECT_EQ(counters.awakeBodies, pile.boxes.size());
        EXPECT_EQ(counters.islands, 1U);
        EXPECT_EQ(counters.touching, touching);
        for (const BodyId id : pile.boxes) {
            EXPECT_TRUE(pile.world.isAwake(id));
            EXPECT_EQ(velocityOf(pile.world, id), DVec2{});
        }
    }
}

/// The impulses that it keeps are those of the equilibrium: they carry its weight.
TEST(Held, ContactsCarryTheWeight) {
    for (const Profile profile : kProfiles) {
        Pile pile(profile);
        ASSERT_TRUE(pile.isHeld());
        double carried = 0;
        pile.world.visitContacts([&](const ContactView& contact) {
            if (contact.bodyA == pile.ground) { carried += static_cast<double>(contact.impulse); }
        });
        EXPECT_NEAR(carried, 10 * kGravity * kStep, 10 * kGravity * kStep / 1024);
    }
}

/// Held or solved on, it ends at the same place but for a small part of what its contacts give.
TEST(Held, HardlyDiffersFromSolvingOn) {
    for (const Profile profile : kProfiles) {
        Pile held(settingsOf(profile), 0);
        Pile solved(settingsOf(profile), 0);
        for (int i = 0; i < 300; ++i) {
            if (i < 10) { held.nudge(); }  // else it would stand as it begins, without having sunk in at all
            solved.nudge();
            run(held.world, 1);
            run(solved.world, 1);
        }
        ASSERT_TRUE(held.isHeld());
        EXPECT_GT(solved.world.counters().solvedBodies, 0U);
        expectAtMost("held against solved", held.moveSince(solved.places()), profile == Profile::fast ? 2e-4 : 1e-6);
    }
}

template <class Change>
void expectReleases(const char* name, const Change& change) {
    for (const Profile profile : kProfiles) {
        Pile pile(profile);
        ASSERT_TRUE(pile.isHeld()) << name;
        change(pile);
        run(pile.world, 1);
        EXPECT_FALSE(pile.isHeld()) << name;
        EXPECT_GT(pile.world.counters().solvedBodies + pile.world.counters().freeBodies, 0U) << name;
    }
}

TEST(Held, AnythingThatConcernsItReleasesIt) {
    expectReleases("force", [](Pile& pile) {
        must(pile.world.applyForce(pile.boxes[0], vec(0.5, 0), pile.world.centerOfMass(pile.boxes[0])));
    });
    expectReleases("torque", [](Pile& pile) { must(pile.world.applyTorque(pile.boxes[9], real(0.5))); });
    expectReleases("impulse", [](Pile& pile) {
        must(pile.world.applyImpulse(pile.boxes[4], vec(0.5, 0), pile.world.centerOfMass(pile.boxes[4])));
    });
    expectReleases("velocity", [](Pile& pile) { must(pile.world.setVelocity(pile.boxes[2], vec(0, 1), 0)); });
    expectReleases("teleport", [](Pile& pile) { must(pile.world.setPose(pile.boxes[9], {5, 5}, 0)); });
    expectReleases("ground", [](Pile& pile) { must(pile.world.setPose(pile.ground, {0, -0.501}, 0)); });
    expectReleases("destroyed", [](Pile& pile) { must(pile.world.destroyBody(pile.boxes[1])); });
    expectReleases("ground destroyed", [](Pile& pile) { must(pile.world.destroyBody(pile.ground)); });
    expectReleases("heavier", [](Pile& pile) { must(pile.world.addShape(pile.boxes[9], circle(0.5))); });
    expectReleases("gravity", [](Pile& pile) {
        WorldSettings settings = pile.world.settings();
        settings.gravity = vec(0.5, -10);
        must(pile.world.configure(settings));
    });
    expectReleases("put on top", [](Pile& pile) {
        addBody(pile.world, dynamicAt({0, 4.5}), box(0.5, 0.5), material(0.6));
    });
    expectReleases("hung on a joint", [](Pile& pile) {
        MouseJointDef def;
        def.base.bodyA = pile.ground;
        def.base.bodyB = pile.boxes[9];
        def.target = {0, 8};
        must(pile.world.createJoint(def));
    });
    expectReleases("wall put into it", [](Pile& pile) { addStatic(pile.world, box(0.1, 3), {}, {2.1, 3}); });
    expectReleases("pushed by a kinematic body", [](Pile& pile) {
        BodyDef def = bodyAt(BodyType::kinematic, {-2.58, 0.5});
        def.velocity = vec(1, 0);
        addBody(pile.world, def, box(0.5, 0.4));
    });
    // One at rest wakes nobody, but what is awake has to get out of it.
    const DVec2 inside{-2.3, 0.5};
    expectReleases("kinematic body put into it",
                   [inside](Pile& pile) { addBody(pile.world, bodyAt(BodyType::kinematic, inside), box(0.5, 0.4)); });
    expectReleases("kinematic body teleported into it", [inside](Pile& pile) {
        const BodyId body = addBody(pile.world, bodyAt(BodyType::kinematic, {-8, 0.5}), box(0.5, 0.4));
        run(pile.world, 1);
        ASSERT_TRUE(pile.isHeld());
        must(pile.world.setPose(body, inside, 0));
    });
    expectReleases("shape of a kinematic body put into it", [inside](Pile& pile) {
        const BodyId body = must(pile.world.createBody(bodyAt(BodyType::kinematic, inside)));
        run(pile.world, 1);
        ASSERT_TRUE(pile.isHeld());
        must(pile.world.addShape(body, box(0.5, 0.4)));
    });
}

/// Its impulses become those of the other step, so that it is in balance with that one, too.
TEST(Held, StaysWhenTheStepChanges) {
    for (const Profile profile : kProfiles) {
        for (const double share : {0.5, 2.0, 1e-3}) {
            Pile pile(profile);
            ASSERT_TRUE(pile.isHeld());
            const std::vector<DVec2> before = pile.places();
            for (int i = 0; i < 60; ++i) { must(pile.world.step(i % 3 == 0 ? kStep : share * kStep)); }
            EXPECT_TRUE(pile.isHeld()) << share;
            EXPECT_EQ(pile.moveSince(before), 0) << share;
            double carried = 0;
            pile.world.visitContacts(pile.ground,
                                     [&](const ContactView& c) { carried += static_cast<double>(c.impulse); });
            EXPECT_NEAR(carried / (share * kStep * 10 * kGravity), 1, 0.01) << share;  // ten boxes of 1 kg
        }
    }
}

/// A kinematic body that passes over it within one step, and touches it at neither end, takes it along.
TEST(Held, IsInTheWayOfFastKinematicBodies) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {400.0, 1000.0}) {
            Pile pile(profile);
            ASSERT_TRUE(pile.isHeld());
            BodyDef def = bodyAt(BodyType::kinematic, {-20, 0.5});
            def.velocity = vec(speed, 0);
            addBody(pile.world, def, box(0.5, 0.4));
            run(pile.world, static_cast<int>(30 * kRate / speed) + 1);  // 10 m beyond it
            EXPECT_FALSE(pile.isHeld());
            EXPECT_GT(momentumOf(pile.world, pile.boxes).x, 0.5 * speed);
        }
    }
}

/// In the very step in which what carried them goes, the others fall.
TEST(Held, FallsAtOnce) {
    for (const Profile profile : kProfiles) {
        Pile pile(profile);
        ASSERT_TRUE(pile.isHeld());
        must(pile.world.destroyBody(pile.ground));
        run(pile.world, 1);
        const DVec2 momentum = momentumOf(pile.world, pile.boxes);
        EXPECT_NEAR(momentum.y, -10 * kGravity * kStep, 1e-5 * 10 * kGravity * kStep);
        EXPECT_NEAR(momentum.x, 0, 1e-5 * 10 * kGravity * kStep);
    }
}

/// It is there for a blow before that arrives, and takes it as a pile does that was not held.
TEST(Held, TakesABlow) {
    for (const Profile profile : kProfiles) {
        const auto hit = [profile](bool mayHold) {
            Pile pile(profile);
            EXPECT_TRUE(pile.isHeld());
            addBody(pile.world, dynamicAt({-8, 3.5}, vec(20, 4)), circle(0.4), material(0.3, 0.2, 4));
            for (int i = 0; i < 24; ++i) {
                if (!mayHold) { pile.nudge(); }
                run(pile.world, 1);
            }
            EXPECT_FALSE(pile.isHeld());
            return momentumOf(pile.world, pile.boxes);
        };
        const DVec2 held = hit(true);
        const DVec2 solved = hit(false);
        EXPECT_GT(solved.x, 10);
        // Its contacts are solved in another order then: piles of boxes answer to that by some hundredths.
        EXPECT_LT(length(held - solved), 0.15 * length(solved));
    }
}

/// On a slope below its angle of friction a box stays to the bit; beyond it, by a hundredth, it slides as it must.
TEST(Held, SlopesHoldWhatFrictionHolds) {
    const double slope = std::atan(0.5);
    const auto slideOf = [slope](Profile profile, double friction, double seconds) {
        World world = makeWorld(settingsOf(profile));
        addStatic(world, box(200, 0.5), material(friction), turned({0, -0.5}, -slope), -slope);
        BodyDef def = dynamicAt(turned({0, 0.25}, -slope));
        def.angle = -slope;
        const BodyId body = addBody(world, def, box(0.5, 0.25), material(friction));
        runFor(world, 1);
        const DVec2 from = world.position(body);
        const double before = length(velocityOf(world, body));
        runFor(world, seconds);
        return std::pair{length(world.position(body) - from), length(velocityOf(world, body)) - before};
    };
    for (const Profile profile : kProfiles) {
        EXPECT_EQ(slideOf(profile, 0.501, 10).first, 0);
        const double pull = kGravity * (std::sin(slope) - 0.495 * std::cos(slope));
        EXPECT_NEAR(slideOf(profile, 0.495, 2).second, 2 * pull, 0.01 * 2 * pull);
    }
}

/// Awake to the user until it may sleep, and that is as soon as ever.
TEST(Held, FallsAsleepInTime) {
    for (const Profile profile : kProfiles) {
        WorldSettings settings = settingsOf(profile);
        settings.sleep = true;
        Pile pile(settings, 0);
        int steps = 0;
        int held = 0;
        for (; pile.world.isAwake(pile.boxes[0]) && steps < 600; ++steps) {
            run(pile.world, 1);
            held += pile.isHeld() ? 1 : 0;
        }
        // 4·√(extent/|g|) after it has come to within a 1024th of its size
        EXPECT_GE(steps, 75);
        EXPECT_LE(steps, 160);
        EXPECT_GT(held, 10);
        EXPECT_EQ(pile.world.counters().fellAsleep, pile.boxes.size());
        run(pile.world, 1);
        EXPECT_EQ(pile.world.counters().awakeBodies + pile.world.counters().settledBodies, 0U);
    }
}

TEST(Held, MayBePutToSleepAndWoken) {
    Pile pile(Profile::fast);
    ASSERT_TRUE(pile.isHeld());
    must(pile.world.setAwake(pile.boxes[9], false));
    EXPECT_FALSE(pile.world.isAwake(pile.boxes[9]));
    EXPECT_TRUE(pile.world.isAwake(pile.boxes[0]));
    must(pile.world.setAwake(pile.boxes[9], true));
    EXPECT_TRUE(pile.world.isAwake(pile.boxes[9]));
    const std::vector<DVec2> before = pile.places();
    runFor(pile.world, 2);
    EXPECT_TRUE(pile.isHeld());
    expectAtMost("move", pile.moveSince(before), 1e-4);
}

/// A sensor that is put around it sees it.
TEST(Held, SensorsSeeIt) {
    Pile pile(Profile::fast);
    ASSERT_TRUE(pile.isHeld());
    ShapeDef sensor;
    sensor.sensor = true;
    addStatic(pile.world, box(0.3, 0.3), sensor, {0, 3.5});
    run(pile.world, 1);
    int begins = 0;
    for (const ContactEvent& event : pile.world.contactEvents()) {
        begins += event.type == ContactEventType::sensorBegin && event.bodyB == pile.boxes[9] ? 1 : 0;
    }
    EXPECT_EQ(begins, 1);
}

/// Of many that are held one is woken, lies down again, and one is taken away: of the others nothing is looked at, and
/// no contact is lost or kept too long.
TEST(Held, ConcernsNobodyElse) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(settingsOf(profile));
        addStatic(world, box(100, 0.5), material(0.6), {0, -0.5});
        std::vector<BodyId> uppers;
        std::vector<BodyId> lowers;
        for (int i = 0; i < 20; ++i) {
            lowers.push_back(addBody(world, dynamicAt({4.0 * i - 40, 0.5}), box(0.5, 0.5)));
            uppers.push_back(addBody(world, dynamicAt({4.0 * i - 40, 1.5}), box(0.5, 0.5)));
        }
        runFor(world, 4);
        ASSERT_EQ(world.counters().settledBodies, 40U);
        ASSERT_EQ(world.counters().touching, 40U);
        must(world.applyImpulse(uppers[7], vec(0, 2), world.centerOfMass(uppers[7])));
        run(world, 1);
        EXPECT_EQ(world.counters().settledBodies, 38U);
        EXPECT_LE(world.counters().manifolds, 3U);
        runFor(world, 4);
        EXPECT_EQ(world.counters().settledBodies, 40U);
        EXPECT_EQ(world.counters().touching, 40U);
        must(world.destroyBody(lowers[3]));
        run(world, 1);
        EXPECT_EQ(world.counters().settledBodies, 38U);
        EXPECT_EQ(world.counters().touching, 38U);
        EXPECT_EQ(world.contactEvents().size(), 2U) << "both contacts of what is gone end";
        runFor(world, 4);
        EXPECT_EQ(world.counters().settledBodies, 39U);
        EXPECT_NEAR(world.position(uppers[3]).y, 0.5, 0.01);
        EXPECT_EQ(world.counters().touching, 39U);
    }
}

/// In `fast` too, twice the lengths, masses or times give twice the numbers, to the bit.
TEST(Held, ScalesByPowersOfTwo) {
    const auto endOf = [](double length, double mass, double time) {
        WorldSettings settings = awakeSettings(kGravity * length / (time * time));
        settings.profile = Profile::fast;
        World world = makeWorld(settings);
        addStatic(world, box(10 * length, 0.5 * length), material(0.6), {0, -0.5 * length});
        BodyId last;
        std::uint64_t held = 0;
        for (int i = 0; i < 4; ++i) {
            last = addBody(world, dynamicAt({0.1 * i * length, (i + 0.5) * length}), box(0.5 * length, 0.5 * length),
                           material(0.6, 0, mass / (length * length)));
        }
        for (int i = 0; i < 200; ++i) {
            run(world, 1, kStep * time);
            held += world.counters().settledBodies;
        }
        EXPECT_EQ(world.counters().settledBodies, 4U);
        return std::pair{1 / length * world.position(last), held};
    };
    const auto plain = endOf(1, 1, 1);
    for (const double factor : {1.0 / 64, 32.0}) {
        EXPECT_EQ(endOf(factor, 1, 1), plain) << "length";
        EXPECT_EQ(endOf(1, factor, 1), plain) << "mass";
        EXPECT_EQ(endOf(1, 1, factor), plain) << "time";
    }
}

/// What is made at rest inside of something that carries it has no balance there, though impulses for one can be found:
/// it is pushed out, as anything that got there.
TEST(Held, NotWhereItWouldBePushedOut) {
    for (const Profile profile : kProfiles) {
        const double h = kStep / (profile == Profile::fast ? 4 : 16);
        const double give = 8 * kGravity * h * h;
        for (const double depth : {0.01, 0.1, 0.45}) {
            World world = makeWorld(settingsOf(profile));
            addStatic(world, box(10, 1), material(0.6));
            const BodyId square = addBody(world, dynamicAt({-3, 1.5 - depth}), box(0.5, 0.5), material(0.6));
            addBody(world, dynamicAt({0, 1.5 - depth}), circle(0.5), material(0.6));
            BodyDef tilted = dynamicAt({3, 1.5 - depth});
            tilted.angle = real(0.1);
            addBody(world, tilted, box(0.5, 0.5), material(0.6));
            addBody(world, dynamicAt({6, 1.5}), box(0.5, 0.5), material(0.6));
            addBody(world, dynamicAt({6, 2.5 - depth}), box(0.5, 0.5), material(0.6));
            runFor(world, 3);
            expectAtMost("depth, m", deepestOverlap(world), give);
            EXPECT_GE(world.counters().settledBodies, 5U) << "and is held where it came to rest";
            // Nor what gets such a shape while it is held.
            must(world.addShape(square, must(makeBox(vec(0.1, 0.1), vec(0, -0.5 - depth)))));
            runFor(world, 3);
            expectAtMost("depth with another shape, m", deepestOverlap(world), give);
        }
    }
}

}  // namespace
}  // namespace swept::test
