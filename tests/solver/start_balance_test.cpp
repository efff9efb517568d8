#include <gtest/gtest.h>

#include <cmath>

#include <swept/solver/direct/start_balance.h>

#include "solver_scene.h"

/// What a joint begins with that is made beside bodies which contacts carry already.

namespace swept::test {
namespace {

constexpr double kH = 1.0 / 240;
constexpr double kWeight = 10 * kH;  // impulse of a sub-step on 1 kg

BodySlot addBody(SolverBatch& batch, double mass) {
    SceneBody body = bodyAt(0, 0, mass);
    body.drive = driveOf({0, -10}, real(kH));
    return add(batch, body);
}

/// To the fixed world, at the centre.
void hang(SolverBatch& batch, BodySlot body) {
    RevoluteConstraint hinge;
    hinge.slotB = body;
    hinge.centerOffset = {0, 1};
    hinge.anchorA = {0, 1};
    batch.revolutes.push_back(hinge);
}

/// On the ground, along a normal.
ContactConstraint& addGround(SolverBatch& batch, BodySlot body, Vec2 normal) {
    ContactConstraint contact;
    contact.slotB = body;
    contact.normal = normal;
    contact.friction = 1;
    batch.contacts.push_back(contact);
    return batch.contacts.back();
}

void addPoint(ContactConstraint& contact, Vec2 anchor, double normal, double tangent) {
    ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(contact.count++)];
    point.anchorA = point.anchorB = anchor;
    point.normalImpulse = real(normal);
    point.tangentImpulse = real(tangent);
}

/// A box of 3 kg on two points, of whose weight these carry a part.
ContactConstraint& addCarriedBox(SolverBatch& batch, double part) {
    ContactConstraint& contact = addGround(batch, addBody(batch, 3), {0, 1});
    for (const double x : {-0.5, 0.5}) { addPoint(contact, {real(x), real(-0.5)}, part * 1.5 * kWeight, 0); }
    return contact;
}

TEST(StartBalance, LeavesWhatContactsCarryAsItIs) {
    SolverBatch batch;
    batch.clear();
    hang(batch, addBody(batch, 2));
    addCarriedBox(batch, 0.95);
    ASSERT_TRUE(StartBalance{}.find(batch));
    EXPECT_NEAR(batch.revolutes[0].linearImpulse.y, 2 * kWeight, 1e-5 * kWeight);
    for (const ContactConstraintPoint& point : batch.contacts[0].points) {
        EXPECT_EQ(point.normalImpulse, real(0.95 * 1.5 * kWeight));
    }
}

/// What rests on a body is a load of its joints, though its own contacts balance it.
TEST(StartBalance, KnowsTheLoadOfWhatHangs) {
    SolverBatch batch;
    batch.clear();
    const BodySlot platform = addBody(batch, 2);
    hang(batch, platform);
    ContactConstraint& contact = addCarriedBox(batch, 1);
    contact.slotA = platform;
    for (ContactConstraintPoint& point : contact.points) { point.anchorA = {point.anchorB.x, real(0.1)}; }
    ASSERT_TRUE(StartBalance{}.find(batch));
    EXPECT_NEAR(batch.revolutes[0].linearImpulse.y, 5 * kWeight, 1e-4 * kWeight);
    for (const ContactConstraintPoint& point : batch.contacts[0].points) {
        EXPECT_NEAR(point.normalImpulse, 1.5 * kWeight, 1e-4 * kWeight);
    }
}

TEST(StartBalance, FindsWhatContactsDoNotCarryYet) {
    SolverBatch batch;
    batch.clear();
    hang(batch, addBody(batch, 2));
    addCarriedBox(batch, 0.5);
    ASSERT_TRUE(StartBalance{}.find(batch));
    for (const ContactConstraintPoint& point : batch.contacts[0].points) {
        EXPECT_NEAR(point.normalImpulse, 1.5 * kWeight, 1e-4 * kWeight);
    }
}

/// A disk lies still on a slope by what resists its rolling.
TEST(StartBalance, KnowsWhatResistsRolling) {
    constexpr double kRadius = 0.5;
    const double slope = std::acos(-1.0) / 6;
    SolverBatch batch;
    batch.clear();
    hang(batch, addBody(batch, 2));
    const Vec2 normal{real(-std::sin(slope)), real(std::cos(slope))};
    ContactConstraint& contact = addGround(batch, addBody(batch, 1), normal);
    addPoint(contact, real(-kRadius) * normal, kWeight * std::cos(slope), kWeight * std::sin(slope));
    contact.rolling = 1;
    contact.rollingImpulse = real(-kRadius * kWeight * std::sin(slope));
    ASSERT_TRUE(StartBalance{}.find(batch));
    EXPECT_NEAR(batch.revolutes[0].linearImpulse.y, 2 * kWeight, 1e-5 * kWeight);
    EXPECT_EQ(batch.contacts[0].points[0].normalImpulse, real(kWeight * std::cos(slope)));
}

}  // namespace
}  // namespace swept::test
