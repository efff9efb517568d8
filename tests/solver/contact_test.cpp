#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "../support/random.h"
#include "random_solve.h"
#include "solver_scene.h"

namespace swept::test {
namespace {

constexpr Real kGravity = Real(-10);

/// A box of half size 0.5 and 1 kg over the plane through the origin with normal (sin angle, cos angle) turned.
struct BoxOnPlane {
    SolverSettings settings{.dt = real(1.0 / 64), .subSteps = 4, .relaxPasses = 1, .restitutionThreshold = real(0.2)};
    double slope = 0;  ///< rad
    Real friction = real(0.5);
    SceneBody box = bodyAt(0, 0.5, 1, 1.0 / 6);
    SolverBatch batch;
    Solver solver;
    std::array<Real, 2> normalImpulses{};  ///< of the last sub-step
    std::array<Real, 2> tangentImpulses{};

    Vec2 normal() const { return turned(slope, 0, 1); }
    Vec2 downhill() const { return turned(slope, -1, 0); }
    Real h() const { return settings.dt / static_cast<Real>(settings.subSteps); }
    /// Height of the box's centre over its place on the plane.
    double height() const { return -std::sin(slope) * box.x + std::cos(slope) * box.y - 0.5; }

    void place(double separation) {
        box.x = -std::sin(slope) * (0.5 + separation);
        box.y = std::cos(slope) * (0.5 + separation);
        box.angle = slope;
    }

    ContactConstraint contact(BodySlot slot) const {
        ContactConstraint c;
        c.slotB = slot;
        c.normal = normal();
        c.friction = friction;
        c.maxPushSpeed = 4;
        c.softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, h());
        c.count = 2;
        for (std::size_t i = 0; i < 2; ++i) {
            const Vec2 arm = turned(box.angle, i == 0 ? -0.5 : 0.5, -0.5);
            const double x = box.x + static_cast<double>(arm.x);
            const double y = box.y + static_cast<double>(arm.y);
            c.points[i].anchorB = arm;
            c.points[i].anchorA = {real(x), real(y)};
            c.points[i].baseSeparation = real(-std::sin(slope) * x + std::cos(slope) * y);
            c.points[i].normalImpulse = normalImpulses[i];
            c.points[i].tangentImpulse = tangentImpulses[i];
        }
        return c;
    }

    void step() {
        batch.clear();
        box.drive = driveOf({0, kGravity}, h());
        const BodySlot slot = add(batch, box);
        batch.contacts.push_back(contact(slot));
        solver.solve(batch, settings);
        for (std::size_t i = 0; i < 2; ++i) {
            normalImpulses[i] = batch.contacts[0].points[i].normalImpulse;
            tangentImpulses[i] = batch.contacts[0].points[i].tangentImpulse;
        }
        finishStep(box, batch.states[slot]);
    }
};

TEST(Contact, RestsOnTheFixedWorld) {
    BoxOnPlane scene;
    scene.place(0);
    double deepest = 0;
    for (int i = 0; i < 256; ++i) {
        scene.step();
        deepest = std::min(deepest, scene.height());
    }
    EXPECT_GT(deepest, -0.002);
    EXPECT_NEAR(scene.height(), 0, 0.001);
    EXPECT_LT(length(scene.box.state.velocity), real(1e-4));
    EXPECT_LT(std::fabs(scene.box.state.angularVelocity), real(1e-4));
    // The sub-step's impulse carries the weight.
    EXPECT_NEAR(scene.normalImpulses[0] + scene.normalImpulses[1], -kGravity * scene.h(),
                -kGravity * scene.h() * real(1e-3));
    EXPECT_EQ(scene.batch.states[kFixedSlot].velocity, Vec2{}) << "the fixed world is never written";
}

TEST(Contact, ClosesAGapWithoutPenetrating) {
    BoxOnPlane scene;
    scene.place(0.05);
    scene.box.state.velocity = {0, -1};
    bool touched = false;
    for (int i = 0; i < 64; ++i) {
        scene.step();
        ASSERT_GT(scene.height(), -0.002);
        touched = touched || scene.normalImpulses[0] > 0;
    }
    EXPECT_TRUE(touched);
    EXPECT_NEAR(scene.height(), 0, 0.001);
}

TEST(Contact, PushesOutOfAnOverlapWithoutThrowing) {
    BoxOnPlane scene;
    scene.place(-0.2);
    double fastest = 0;
    for (int i = 0; i < 128; ++i) {
        scene.step();
        if (scene.height() > -0.002) { fastest = std::max(fastest, static_cast<double>(scene.box.state.velocity.y)); }
        ASSERT_LT(scene.height(), 0.001) << "step " << i;
    }
    EXPECT_LT(fastest, 0.01) << "relaxation takes the speed of the push back";
    EXPECT_GT(scene.height(), -0.002) << "it has come out";
}

TEST(Contact, PushesNoFasterThanAllowed) {
    BoxOnPlane scene;
    scene.place(-0.4);
    for (int i = 0; i < 4; ++i) {
        const double before = scene.height();
        scene.step();
        EXPECT_LE(scene.height() - before, 4.0 / 64 * 1.0001);
        EXPECT_GT(scene.height(), before);
    }
}

TEST(Contact, BlockOnAnInclineSlidesAsCoulombSays) {
    for (const double slope : {0.2, 0.5, 0.7, -0.5}) {
        for (const double mu : {0.0, 0.1, 0.3, 0.6, 1.0}) {
            BoxOnPlane scene;
            scene.slope = slope;
            scene.friction = real(mu);
            scene.place(0);
            for (int i = 0; i < 16; ++i) { scene.step(); }  // settles
            const double start =
                static_cast<double>(dot(scene.box.state.velocity, scene.downhill())) * (slope < 0 ? -1 : 1);
            constexpr int kSteps = 64;  // one second
            for (int i = 0; i < kSteps; ++i) { scene.step(); }
            const double end =
                static_cast<double>(dot(scene.box.state.velocity, scene.downhill())) * (slope < 0 ? -1 : 1);
            const double steep = std::fabs(slope);
            const double drive = 10 * (std::sin(steep) - mu * std::cos(steep));
            if (std::tan(steep) > mu) {
                EXPECT_NEAR(end - start, drive, 0.01 * drive + 1e-3) << "slope " << slope << " friction " << mu;
            } else {
                EXPECT_NEAR(end, 0, 1e-4) << "slope " << slope << " friction " << mu;
            }
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_LE(std::fabs(scene.tangentImpulses[i]), real(mu) * scene.normalImpulses[i]);
            }
        }
    }
}

TEST(Contact, SticksJustBelowTheFrictionAngleAndSlidesJustAbove) {
    const double slope = 0.4;
    for (const double share : {0.98, 1.02}) {
        BoxOnPlane scene;
        scene.slope = slope;
        scene.friction = real(share * std::tan(slope));
        scene.place(0);
        for (int i = 0; i < 256; ++i) { scene.step(); }
        const double speed = static_cast<double>(dot(scene.box.state.velocity, scene.downhill()));
        if (share > 1) {
            EXPECT_NEAR(speed, 0, 1e-4);
        } else {
            EXPECT_NEAR(speed, 4 * 10 * 0.02 * std::sin(slope), 0.1 * 4 * 10 * 0.02 * std::sin(slope));
        }
    }
}

/// A ball dropped on the floor keeps restitution² of its energy at each bounce.
TEST(Contact, BouncesAtTheSubStepInWhichItMeets) {
    SolverBatch batch;
    Solver solver;
    const SolverSettings settings{.dt = real(1.0 / 64), .subSteps = 16, .restitutionThreshold = real(0.2)};
    const Real h = settings.dt / 16;
    SceneBody ball = bodyAt(0, 2.5, 1, 0.125);
    ball.drive = driveOf({0, kGravity}, h);
    double highest = 0;
    bool bounced = false;
    for (int i = 0; i < 96; ++i) {
        batch.clear();
        const BodySlot slot = add(batch, ball);
        ContactConstraint contact;
        contact.slotB = slot;
        contact.normal = {0, 1};
        contact.restitution = real(0.5);
        contact.maxPushSpeed = 4;
        contact.softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, h);
        contact.count = 1;
        contact.points[0].anchorB = {0, real(-0.5)};
        contact.points[0].anchorA = {0, real(ball.y - 0.5)};
        contact.points[0].baseSeparation = real(ball.y - 0.5);
        batch.contacts.push_back(contact);
        const SolveReport report = solver.solve(batch, settings);
        bounced = bounced || report.bounceRounds > 0;
        if (report.bounceRounds > 0) {
            EXPECT_NEAR(batch.contacts[0].points[0].bounceApproach, std::sqrt(40), 0.05);
            EXPECT_NEAR(batch.contacts[0].points[0].totalNormalImpulse, 1.5 * std::sqrt(40), 0.1);
        }
        finishStep(ball, batch.states[slot]);
        if (bounced) { highest = std::max(highest, ball.y - 0.5); }
        if (bounced && ball.state.velocity.y < 0) { break; }
    }
    EXPECT_NEAR(highest, 2 * 0.25, 0.01);
}

TEST(Contact, SpeedLimitIsAppliedAndReported) {
    SolverBatch batch;
    batch.clear();
    SceneBody fast = bodyAt(0, 0);
    fast.state.velocity = {30, 40};
    SceneBody slow = bodyAt(0, 0);
    slow.state.velocity = {3, 4};
    const BodySlot fastSlot = add(batch, fast);
    const BodySlot slowSlot = add(batch, slow);
    Solver solver;
    const SolveReport report = solver.solve(batch, {.dt = 1, .subSteps = 4, .maxSpeed = 10});
    EXPECT_EQ(report.speedsLimited, 1);
    EXPECT_NEAR(batch.states[fastSlot].velocity.x, 6, 20 * kEpsilon);
    EXPECT_NEAR(batch.states[fastSlot].velocity.y, 8, 20 * kEpsilon);
    EXPECT_EQ(batch.states[slowSlot].velocity, (Vec2{3, 4}));
    EXPECT_EQ(batch.states[slowSlot].deltaPosition, (Vec2{3, 4}));
}

/// Two bodies and a contact with two points, all of it random; both points apart, so that nothing about them is soft.
struct TwoPoints {
    static constexpr Real kStep = Real(1) / 256;
    SolverBatch batch;
    ContactConstraint contact;

    explicit TwoPoints(std::uint64_t seed) {
        Random random(seed);
        const auto number = [&](double from, double to) { return static_cast<Real>(random.range(from, to)); };
        batch.clear();
        for (int i = 0; i < 2; ++i) {
            const BodyState state{.velocity = {number(-2, 2), number(-2, 2)}, .angularVelocity = number(-4, 4)};
            batch.addBody(state, {number(0.2, 1), random.chance(0.2) ? Real(0) : number(0, 6)}, {});
        }
        contact.slotA = 1;
        contact.slotB = random.chance(0.3) ? kFixedSlot : 2;
        contact.normal = turned(random.range(0, 6), 1, 0);
        contact.count = 2;
        for (ContactConstraintPoint& point : contact.points) {
            point.anchorA = {number(-1, 1), number(-1, 1)};
            point.anchorB = {number(-1, 1), number(-1, 1)};
            point.baseSeparation = number(0.0001, random.chance(0.5) ? 0.001 : 0.02);
            point.normalImpulse = random.chance(0.5) ? Real(0) : number(0, 1);
        }
    }
    void solve() {
        prepareContact(contact, batch.inertias);
        const std::uint32_t place = 0;
        solveContacts(std::span(&contact, 1), std::span(&place, 1), {batch.states, batch.inertias},
                      {.h = kStep, .useBias = true});
    }
    /// What is left of the gap of a point at the end of the sub-step, as a speed.
    Real rest(const ContactConstraintPoint& point) const {
        const Vec2 velocity = velocityAt(batch.states[contact.slotB], point.anchorB) -
                              velocityAt(batch.states[contact.slotA], point.anchorA);
        return dot(velocity, contact.normal) + point.separation / kStep;
    }
};

/// Signorini's conditions, which have one solution: no point pulls, none goes farther than its gap, and none that does
/// not reach the end of it presses. (That one was apart once let the other one through: both would have pulled.)
TEST(Contact, TwoPointsPressWhereTheyMeetAndNowhereElse) {
    int none = 0;
    int both = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        TwoPoints scene(seed);
        scene.solve();
        int pressing = 0;
        for (const ContactConstraintPoint& point : scene.contact.points) {
            const Real tolerance = 4096 * kEpsilon;  // of bodies that hardly turn, whose two rows are nearly one
            const Real rest = scene.rest(point);
            ASSERT_GE(point.normalImpulse, 0) << "seed " << seed;
            ASSERT_GE(rest, -tolerance) << "seed " << seed;
            ASSERT_LE(point.normalImpulse * rest, tolerance) << "seed " << seed;
            pressing += point.normalImpulse > 0 ? 1 : 0;
        }
        none += pressing == 0 ? 1 : 0;
        both += pressing == 2 ? 1 : 0;
    }
    EXPECT_GT(none, 1'000);
    EXPECT_GT(both, 1'000);
}

/// Kinetic, J.
double energyOf(const SolverBatch& batch) {
    double sum = 0;
    for (std::size_t i = 0; i < batch.states.size(); ++i) {
        const BodyInertia& inertia = batch.inertias[i];
        const BodyState& state = batch.states[i];
        const double speed = static_cast<double>(length(state.velocity));
        const double spin = static_cast<double>(state.angularVelocity);
        if (inertia.inverseMass > 0) { sum += speed * speed / (2 * static_cast<double>(inertia.inverseMass)); }
        if (inertia.inverseInertia > 0) { sum += spin * spin / (2 * static_cast<double>(inertia.inverseInertia)); }
    }
    return sum;
}

/// Prepared for `bounceContacts`.
ContactConstraint bouncing(ContactConstraint contact, const SolverBatch& batch) {
    prepareContact(contact, batch.inertias);
    return contact;
}

/// Newton's law, and no friction: v − v₂ = −e·(u − u₂), and momentum.
TEST(BounceInTurn, BallsPartWithTheirRestitution) {
    for (const double restitution : {0.25, 0.5, 1.0}) {
        SolverBatch batch;
        batch.clear();
        batch.addBody({.velocity = {4, 0}}, {real(0.5), 1}, {});
        batch.addBody({.velocity = {-1, 0}}, {1, 1}, {});
        ContactConstraint contact;
        contact.slotA = 1;
        contact.slotB = 2;
        contact.normal = {1, 0};
        contact.restitution = real(restitution);
        contact.count = 1;
        contact.points[0].anchorA = {1, 0};
        contact.points[0].anchorB = {-1, 0};
        contact.points[0].baseSeparation = real(0.05);
        const std::array<std::uint32_t, 1> places{0};
        const auto bounceWith = [&](Real bounceSpeed, double h, Real leastRestitution = 0) {
            std::vector<ContactConstraint> contacts{bouncing(contact, batch)};
            bounceContacts(contacts, places, {batch.states, batch.inertias},
                           {.h = real(h), .bounceSpeed = bounceSpeed, .leastRestitution = leastRestitution});
            return contacts[0].points[0].totalNormalImpulse;
        };
        EXPECT_EQ(bounceWith(6, 1), 0) << "too slow";
        EXPECT_EQ(bounceWith(1, 1.0 / 128), 0) << "they do not meet in this sub-step";
        EXPECT_EQ(bounceWith(1, 1.0 / 32, real(restitution)), 0) << "others are meant";
        EXPECT_EQ(batch.states[1].velocity, (Vec2{4, 0}));
        EXPECT_GT(bounceWith(1, 1.0 / 32), 0);
        const double first = static_cast<double>(batch.states[1].velocity.x);
        const double second = static_cast<double>(batch.states[2].velocity.x);
        EXPECT_NEAR(second - first, 5 * restitution, 1e-5);
        EXPECT_NEAR(2 * first + second, 7, 1e-5);
    }
}

/// A box that lands flat does not turn, whatever the order of its points.
TEST(BounceInTurn, BoxesLeaveFlatGroundFlat) {
    BoxOnPlane scene;
    SolverBatch batch;
    batch.clear();
    const BodySlot slot = add(batch, scene.box);
    batch.states[slot].velocity = {0, -3};
    std::vector<ContactConstraint> contacts{scene.contact(slot)};
    contacts[0].restitution = real(0.5);
    contacts[0] = bouncing(contacts[0], batch);
    const std::array<std::uint32_t, 1> places{0};
    bounceContacts(contacts, places, {batch.states, batch.inertias}, {.h = real(1.0 / 64), .bounceSpeed = 1});
    EXPECT_NEAR(static_cast<double>(batch.states[slot].velocity.y), 1.5, 1e-6);
    EXPECT_NEAR(static_cast<double>(batch.states[slot].angularVelocity), 0, 1e-6);
}

/// Any contacts with restitution and friction, in any order.
TEST(BounceInTurn, NeverMakesEnergy) {
    int bounced = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        RandomSolve solve(seed);
        for (ContactConstraint& contact : solve.batch.contacts) { contact = bouncing(contact, solve.batch); }
        for (std::uint32_t i = 0; i < solve.batch.contacts.size(); ++i) {
            // What kinematic bodies give is theirs, and so is what a spin gives that nothing changes.
            for (std::size_t k = 0; k < solve.batch.states.size(); ++k) {
                if (!isMovable(solve.batch.inertias[k])) { solve.batch.states[k] = {}; }
                if (!(solve.batch.inertias[k].inverseInertia > 0)) { solve.batch.states[k].angularVelocity = 0; }
            }
            const double before = energyOf(solve.batch);
            const std::array<std::uint32_t, 1> places{i};
            bounceContacts(solve.batch.contacts, places, {solve.batch.states, solve.batch.inertias}, {.h = 1});
            EXPECT_LE(energyOf(solve.batch), before * (1 + 64 * std::numeric_limits<Real>::epsilon())) << seed;
            for (const ContactConstraintPoint& point : solve.batch.contacts[i].points) {
                EXPECT_GE(point.totalNormalImpulse, 0) << seed;
                bounced += point.totalNormalImpulse > 0 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(bounced, 300);
}

}  // namespace
}  // namespace swept::test
