#include <gtest/gtest.h>

#include <vector>

#include "newton_reference.h"

namespace swept::test {
namespace {

constexpr Wide kEps = kEpsilon;

std::vector<ImpactFamily> everyFamily() {
    std::vector<ImpactFamily> families;
    for (const Form form : {Form::bar, Form::box, Form::disk}) {
        for (const Partner partner : {Partner::dynamic, Partner::still, Partner::kinematic}) {
            families.push_back({.form = form, .partner = partner, .points = 1});
            if (form == Form::disk) { continue; }
            families.push_back({.form = form, .partner = partner, .points = 2, .spinningPartner = false});
        }
    }
    return families;
}

/// Calls `check(case, seed)` for many impacts of every family, more than 10⁵ in all.
template <class Check>
void forEveryImpact(Check&& check) {
    std::uint64_t family = 0;
    for (const ImpactFamily& f : everyFamily()) {
        for (std::uint64_t i = 0; i < 8'000; ++i) {
            const std::uint64_t seed = (family << 32U) + i;
            check(randomImpact(f, seed), seed);
            if (testing::Test::HasFatalFailure()) { return; }
        }
        ++family;
    }
}

Wide largestScale(const ImpactCase& before, const ImpactCase& after, int i) {
    return std::max(speedScale(before, i), speedScale(after, i));
}

/// Whether the two points answer so nearly alike that one impulse stands for both; they then differ by a share of about
/// the square root of that nearness.
bool actsAsOnePoint(const ImpactCase& c) {
    if (c.contact.count < 2) { return false; }
    Wide k[2][2] = {};
    const WideVec n = wide(c.contact.normal);
    const auto arm = [&](int i, bool ofA) {
        const ContactConstraintPoint& point = c.contact.points[static_cast<std::size_t>(i)];
        return wide(ofA ? point.anchorA : point.anchorB);
    };
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            k[i][j] = Wide(c.inertias[1].inverseMass) + Wide(c.inertias[2].inverseMass) +
                      Wide(c.inertias[1].inverseInertia) * cross(arm(i, true), n) * cross(arm(j, true), n) +
                      Wide(c.inertias[2].inverseInertia) * cross(arm(i, false), n) * cross(arm(j, false), n);
        }
    }
    return k[0][0] * k[1][1] - k[0][1] * k[1][0] <= 32 * kEps * k[0][0] * k[1][1];
}

TEST(Impact, NeverMakesEnergy) {
    int applied = 0;
    forEveryImpact([&](const ImpactCase& before, std::uint64_t seed) {
        ImpactCase after = before;
        if (!resolveImpact(after.contact, after.bodies(), {})) { return; }
        ++applied;
        ASSERT_LE(kineticEnergy(after), kineticEnergy(before) + energyRounding(before, after)) << "seed " << seed;
    });
    EXPECT_GT(applied, 60'000);
}

TEST(Impact, NeverMakesEnergyOverManyRounds) {
    forEveryImpact([&](const ImpactCase& before, std::uint64_t seed) {
        ImpactCase after = before;
        ContactConstraint* contacts[] = {&after.contact};
        const int rounds = resolveImpacts(contacts, after.bodies(), {.resolvePlastic = true}, 64);
        ASSERT_LE(kineticEnergy(after), kineticEnergy(before) + (1 + rounds) * energyRounding(before, after))
            << "seed " << seed;
        if (rounds == 64) { return; }
        for (int i = 0; i < after.contact.count; ++i) {
            ASSERT_LE(approachOf(after, i), 16 * kEps * largestScale(before, after, i)) << "seed " << seed;
        }
    });
}

TEST(Impact, ConservesMomentum) {
    forEveryImpact([&](const ImpactCase& before, std::uint64_t seed) {
        if (!(before.inertias[1].inverseMass > 0)) { return; }
        ImpactCase after = before;
        resolveImpact(after.contact, after.bodies(), {});
        WideVec change;
        Wide spinChange = 0;
        Wide scale = 0;
        Wide spinScale = 0;
        bool allTurn = true;
        for (std::size_t slot = 1; slot < 3; ++slot) {
            const Wide mass = 1 / Wide(before.inertias[slot].inverseMass);
            const WideVec gained = mass * (wide(after.states[slot].velocity) - wide(before.states[slot].velocity));
            const WideVec arm = wide(slot == 1 ? before.contact.points[0].anchorA : before.contact.points[0].anchorB);
            change = change + gained;
            spinChange = spinChange - cross(arm, gained);  // the body's centre stands at −arm
            const Wide most =
                mass * (norm(wide(before.states[slot].velocity)) + norm(wide(after.states[slot].velocity)));
            scale += most;
            spinScale += norm(arm) * most;
            allTurn = allTurn && before.inertias[slot].inverseInertia > 0;
            if (!(before.inertias[slot].inverseInertia > 0)) { continue; }
            const Wide inertia = 1 / Wide(before.inertias[slot].inverseInertia);
            const Wide first = before.states[slot].angularVelocity;
            const Wide last = after.states[slot].angularVelocity;
            spinChange += inertia * (last - first);
            spinScale += inertia * (std::fabs(first) + std::fabs(last));
        }
        ASSERT_LE(norm(change), 8 * kEps * scale) << "seed " << seed;
        // A body that may not turn takes angular momentum out of the pair.
        if (allTurn) { ASSERT_LE(std::fabs(spinChange), 8 * kEps * spinScale) << "seed " << seed; }
    });
}

TEST(Impact, ElasticWithoutFrictionKeepsTheEnergy) {
    int applied = 0;
    forEveryImpact([&](ImpactCase before, std::uint64_t seed) {
        before.contact.friction = 0;
        before.contact.restitution = 1;
        ImpactCase after = before;
        applied += resolveImpact(after.contact, after.bodies(), {}) ? 1 : 0;
        ASSERT_LE(apart(kineticEnergy(after), kineticEnergy(before)), energyRounding(before, after)) << "seed " << seed;
    });
    EXPECT_GT(applied, 60'000);
}

TEST(Impact, FrictionlessPointLeavesAtRestitutionTimesItsApproach) {
    int applied = 0;
    forEveryImpact([&](ImpactCase before, std::uint64_t seed) {
        before.contact.friction = 0;
        if (before.contact.count == 2 || before.contact.restitution == 0) { return; }
        ImpactCase after = before;
        if (!resolveImpact(after.contact, after.bodies(), {})) { return; }
        ++applied;
        const Wide wanted = Wide(before.contact.restitution) * approachOf(before, 0);
        ASSERT_LE(apart(-approachOf(after, 0), wanted), 8 * kEps * largestScale(before, after, 0)) << "seed " << seed;
        ASSERT_GT(after.contact.points[0].bounceApproach, 0);
        ASSERT_LE(apart(after.contact.points[0].bounceApproach, approachOf(before, 0)),
                  8 * kEps * speedScale(before, 0));
    });
    EXPECT_GT(applied, 30'000);
}

TEST(Impact, PlasticImpactLeavesNoApproach) {
    int resolved = 0;
    forEveryImpact([&](ImpactCase before, std::uint64_t seed) {
        before.contact.restitution = 0;
        // Face to face, friction acts after the block and may tip the bodies; that is for the next round.
        if (before.contact.count == 2) { before.contact.friction = 0; }
        ImpactCase after = before;
        if (!resolveImpact(after.contact, after.bodies(), {.resolvePlastic = true})) { return; }
        ++resolved;
        for (int i = 0; i < after.contact.count; ++i) {
            // A point that did not approach may be tipped into approaching by its neighbour.
            if (after.contact.points[static_cast<std::size_t>(i)].bounceApproach == 0) { continue; }
            const Wide share = actsAsOnePoint(before) ? 32 * std::sqrt(kEps) : 256 * kEps;
            ASSERT_LE(approachOf(after, i), share * largestScale(before, after, i)) << "seed " << seed;
        }
    });
    EXPECT_GT(resolved, 60'000);
}

TEST(Impact, FrictionStaysWithinItsCone) {
    int sliding = 0;
    forEveryImpact([&](const ImpactCase& before, std::uint64_t seed) {
        ImpactCase after = before;
        if (!resolveImpact(after.contact, after.bodies(), {})) { return; }
        const WideVec n = wide(before.contact.normal);
        const WideVec t = wide(rightPerp(before.contact.normal));
        const Wide mass = 1 / Wide(before.inertias[2].inverseMass);
        const WideVec impulse = mass * (wide(after.states[2].velocity) - wide(before.states[2].velocity));
        const Wide rounding =
            8 * kEps * mass * (norm(wide(before.states[2].velocity)) + norm(wide(after.states[2].velocity)));
        const Wide mu = before.contact.friction;
        ASSERT_GE(dot(impulse, n), -rounding) << "seed " << seed;
        ASSERT_LE(std::fabs(dot(impulse, t)), mu * dot(impulse, n) + (1 + mu) * rounding) << "seed " << seed;
        const Wide reported =
            Wide(after.contact.points[0].totalNormalImpulse) + Wide(after.contact.points[1].totalNormalImpulse);
        ASSERT_LE(apart(reported, dot(impulse, n)), rounding + 8 * kEps * reported) << "seed " << seed;
        sliding += mu > 0 && std::fabs(dot(impulse, t)) > Wide(0.99) * mu * dot(impulse, n) ? 1 : 0;
    });
    EXPECT_GT(sliding, 10'000);
}

/// The reason for the blend: Newton's rule with friction makes energy in a good share of impacts of slender bodies.
TEST(Impact, BlendsWhereNewtonWithFrictionWouldMakeEnergy) {
    int impacts = 0;
    int gains = 0;
    Wide worstGain = 0;
    for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
        const ImpactCase before = randomImpact({.form = Form::bar, .partner = Partner::still}, seed);
        const Wide approach = approachOf(before, 0);
        if (approach <= 16 * kEps * speedScale(before, 0)) { continue; }
        const Wide e = before.contact.restitution;
        const NewtonResult newton = newtonWithFriction(before, e);
        ASSERT_TRUE(newton.found) << "seed " << seed;
        ImpactCase after = before;
        ASSERT_TRUE(resolveImpact(after.contact, after.bodies(), {})) << "seed " << seed;
        ++impacts;
        const Wide energy = kineticEnergy(before);
        const Wide rounding = energyRounding(before, after);
        const Wide leaving = -approachOf(after, 0);
        const Wide speedRounding = 64 * kEps * largestScale(before, after, 0);
        if (newton.energyChange <= -2 * rounding) {  // Newton's rule is fine: it is what happens
            ASSERT_LE(apart(leaving, e * approach), speedRounding) << "seed " << seed;
            ASSERT_LE(apart(kineticEnergy(after) - energy, newton.energyChange), 8 * rounding) << "seed " << seed;
        } else if (newton.energyChange >= 2 * rounding) {
            ++gains;
            worstGain = std::max(worstGain, newton.energyChange / energy);
            // The blend takes as much of the bounce as costs nothing, and no more.
            ASSERT_LE(apart(kineticEnergy(after), energy), 2 * rounding) << "seed " << seed;
            ASSERT_GE(leaving, -speedRounding) << "seed " << seed;
            ASSERT_LT(leaving, e * approach + speedRounding) << "seed " << seed;
        }
    }
    RecordProperty("gains", gains);
    RecordProperty("impacts", impacts);
    RecordProperty("worstGainPercent", static_cast<int>(100 * worstGain));
    EXPECT_GT(impacts, 40'000);
    EXPECT_GT(gains, impacts / 50);
    EXPECT_GT(worstGain, Wide(0.2));
}

/// At restitution 0 Newton's rule with friction never makes energy: what the blend falls back to is safe.
TEST(Impact, PlasticPointWithFrictionMatchesTheReference) {
    int impacts = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        ImpactCase before = randomImpact({.form = Form::bar, .partner = Partner::dynamic}, seed);
        before.contact.restitution = 0;
        if (approachOf(before, 0) <= 16 * kEps * speedScale(before, 0)) { continue; }
        const NewtonResult newton = newtonWithFriction(before, 0);
        ASSERT_TRUE(newton.found) << "seed " << seed;
        ASSERT_LE(newton.energyChange, 1e-12L * kineticEnergy(before)) << "seed " << seed;
        ImpactCase after = before;
        resolveImpact(after.contact, after.bodies(), {.resolvePlastic = true});
        ++impacts;
        ASSERT_LE(apart(kineticEnergy(after) - kineticEnergy(before), newton.energyChange),
                  8 * energyRounding(before, after))
            << "seed " << seed;
    }
    EXPECT_GT(impacts, 10'000);
}

/// Work done on B by the reported normal impulses against a turning partner whose points move at different speeds. Two
/// points of a body that cannot turn act as one: the faster of the two must carry the impact.
TEST(Impact, TurningKinematicPartnerMakesNoEnergyInBodiesThatCannotTurn) {
    int applied = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        ImpactCase before = randomImpact(
            {.form = Form::box, .partner = Partner::kinematic, .points = 2, .fixedRotationShare = 1}, seed);
        before.contact.friction = 0;
        ImpactCase after = before;
        if (!resolveImpact(after.contact, after.bodies(), {})) { continue; }
        ++applied;
        Wide work = 0;
        Wide scale = 0;
        for (int i = 0; i < 2; ++i) {
            const Wide impulse = after.contact.points[static_cast<std::size_t>(i)].totalNormalImpulse;
            work -= impulse * (approachOf(before, i) + approachOf(after, i)) / 2;
            scale += impulse * largestScale(before, after, i);
        }
        ASSERT_LE(work, 16 * kEps * scale) << "seed " << seed;
    }
    EXPECT_GT(applied, 8'000);
}

}  // namespace
}  // namespace swept::test
