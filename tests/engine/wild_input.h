#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <swept/shapes/hull.h>

#include "../support/random.h"
#include "world_support.h"

/// Arguments of random calls: mostly what a user would pass, now and then nonsense.

namespace swept::test {

/// How large the numbers may be that are finite and hence hard to refuse.
enum class Sizes { usual, extreme };

class WildInput {
public:
    WildInput(std::uint64_t seed, Sizes sizes) : random_(seed), sizes_(sizes) {}

    double tame() { return random_.range(-4, 4); }
    double huge() { return sizes_ == Sizes::usual ? random_.range(-1e4, 1e4) : 0x1p120 * random_.range(-1, 1); }
    double wild() {
        constexpr auto kMax = static_cast<double>(std::numeric_limits<Real>::max());
        const double large = sizes_ == Sizes::usual ? 1e5 : kMax;
        const std::array<double, 9> odd{std::nan(""), 1 / 0.0, -1 / 0.0, large, -large, 0, -1, 1e-30, huge()};
        return odd[static_cast<std::size_t>(random_.integer(0, 8))];
    }
    double number() { return random_.chance(0.94) ? tame() : wild(); }
    double positive() { return random_.chance(0.94) ? random_.range(0.1, 2) : wild(); }
    Real realNumber() { return static_cast<Real>(number()); }
    Real realPositive() { return static_cast<Real>(positive()); }
    Vec2 vector() { return {realNumber(), realNumber()}; }
    DVec2 place() { return {number(), number()}; }

    /// One of these ids, dead or alive, or one that is made up.
    template <class Id>
    Id any(const std::vector<Id>& ids) {
        if (random_.chance(0.05)) {
            return {static_cast<std::uint32_t>(random_.integer(0, 40)), static_cast<std::uint32_t>(random_.bits())};
        }
        // Mostly recent ones, which are more likely to be alive.
        const int last = static_cast<int>(ids.size()) - 1;
        const int first = random_.chance(0.8) ? std::max(0, last - 20) : 0;
        return ids[static_cast<std::size_t>(random_.integer(first, last))];
    }

    Polygon good() {
        if (random_.chance(0.5)) { return must(makeCircle({}, real(random_.range(0.1, 1)))); }
        const double half = random_.range(0.1, 1);
        return must(makeBox(vec(half, random_.range(0.1, 1))));
    }
    Polygon polygon() {
        if (random_.chance(0.5)) { return good(); }
        if (random_.chance(0.5)) {
            std::vector<Vec2> points;
            const int count = random_.integer(0, 12);
            for (int i = 0; i < count; ++i) { points.push_back(vector()); }
            const Result<Polygon> hull = convexHull(points, random_.chance(0.5) ? Real(0) : realPositive());
            if (hull.ok()) { return hull.value(); }
        }
        Polygon handMade;
        handMade.count = random_.integer(-2, 11);
        handMade.radius = random_.chance(0.5) ? Real(0) : realPositive();
        for (Vec2& vertex : handMade.vertices) { vertex = vector(); }
        for (Vec2& normal : handMade.normals) { normal = vector(); }
        return handMade;
    }
    ShapeDef surface() {
        ShapeDef def;
        if (random_.chance(0.2)) { def.density = realPositive(); }
        if (random_.chance(0.2)) { def.friction = realPositive(); }
        if (random_.chance(0.2)) { def.restitution = realPositive(); }
        def.sensor = random_.chance(0.1);
        def.filter.group = random_.chance(0.1) ? random_.integer(-2, 2) : 0;
        if (random_.chance(0.1)) { def.rollingResistance = realPositive(); }
        if (random_.chance(0.1)) { def.surfaceSpeed = realPositive(); }
        if (random_.chance(0.1)) { def.frictionMixing = mixing(); }
        if (random_.chance(0.1)) { def.restitutionMixing = mixing(); }
        return def;
    }
    MixingRule mixing() { return static_cast<MixingRule>(random_.integer(0, random_.chance(0.1) ? 200 : 5)); }
    WorldSettings settings() {
        WorldSettings settings;
        settings.gravity = vector();
        settings.profile = static_cast<Profile>(random_.integer(0, random_.chance(0.1) ? 200 : 1));
        const int subSteps = random_.chance(0.1) ? random_.integer(-5, 2000) : random_.integer(0, 8);
        if (subSteps != 0) { settings.subSteps = subSteps; }
        const int relaxPasses = random_.integer(-3, 3);
        if (relaxPasses != -1) { settings.relaxPasses = relaxPasses; }
        settings.continuous = static_cast<ContinuousMode>(random_.integer(0, random_.chance(0.1) ? 200 : 4));
        settings.maxImpacts = random_.integer(-1, 12);
        if (random_.chance(0.1)) { settings.maxSpeed = realPositive(); }
        if (random_.chance(0.1)) { settings.toiTolerance = realPositive(); }
        if (random_.chance(0.1)) { settings.maxPenetration = realPositive(); }
        if (random_.chance(0.1)) { settings.maxJointError = realPositive(); }
        if (random_.chance(0.1)) { settings.maxLostTime = random_.range(-0.01, 0.1); }
        settings.sleep = random_.chance(0.8);
        if (random_.chance(0.1)) { settings.sleepSpeed = realPositive(); }
        settings.broadphase =
            static_cast<BroadphaseKind>(random_.integer(0, random_.chance(0.1) ? 200 : kBroadphaseKindCount - 1));
        return settings;
    }

    /// What may be left out mostly is.
    template <class Make>
    auto seldom(Make&& make) -> std::optional<decltype(make())> {
        return random_.chance(0.3) ? std::optional(make()) : std::nullopt;
    }
    std::optional<Spring> spring() {
        return seldom([&] { return Spring{realPositive(), realPositive()}; });
    }
    std::optional<AngularMotor> angularMotor() {
        return seldom([&] { return AngularMotor{realNumber(), realPositive()}; });
    }
    std::optional<LinearMotor> linearMotor() {
        return seldom([&] { return LinearMotor{realNumber(), realPositive()}; });
    }
    std::optional<AngleLimits> angleLimits() {
        return seldom([&] { return ordered<AngleLimits>(); });
    }
    std::optional<TranslationLimits> translationLimits() {
        return seldom([&] { return ordered<TranslationLimits>(); });
    }
    std::optional<LengthLimits> lengthLimits() {
        return seldom([&] { return LengthLimits{realPositive(), realPositive()}; });
    }
    MotorDrive drive() {
        MotorDrive drive;
        drive.linearOffset = seldom([&] { return vector(); });
        drive.linearVelocity = seldom([&] { return vector(); });
        drive.angularOffset = seldom([&] { return realNumber(); });
        drive.angularVelocity = seldom([&] { return realNumber(); });
        drive.maxForce = seldom([&] { return realPositive(); });
        drive.maxTorque = seldom([&] { return realPositive(); });
        return drive;
    }

    Random& random() { return random_; }

private:
    /// Often in the right order.
    template <class Limits>
    Limits ordered() {
        const Real a = realNumber();
        const Real b = realNumber();
        return random_.chance(0.2) ? Limits{a, b} : Limits{std::min(a, b), std::max(a, b)};
    }

    Random random_;
    Sizes sizes_;
};

}  // namespace swept::test
