#include "peer_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <swept/shapes/hull.h>

#include "peer_ragdoll.h"

namespace swept::bench {
namespace {

constexpr double kPi = 3.141592653589793;

Polygon box(Real halfX, Real halfY, Vec2 center = {}) { return makeBox({halfX, halfY}, center).value(); }

PeerBody ground() { return {}; }

PeerBody dynamicAt(double x, double y) {
    PeerBody body;
    body.def.type = BodyType::dynamic;
    body.def.position = {x, y};
    return body;
}

Vec2 onCircle(double radius, double angle) {
    return {static_cast<Real>(radius * std::cos(angle)), static_cast<Real>(radius * std::sin(angle))};
}

/// A floor of tiles a metre wide, −half … half, and walls of `high` more.
PeerBody tub(int half, int high) {
    PeerBody body = ground();
    for (int i = -half; i <= half; ++i) { body.shapes.push_back({box(0.55F, 0.5F, {static_cast<Real>(i), 0})}); }
    for (const int side : {-half, half}) {
        for (int i = 1; i <= high; ++i) {
            body.shapes.push_back({box(0.5F, 0.55F, {static_cast<Real>(side), static_cast<Real>(i)})});
        }
    }
    return body;
}

class Compounds final : public PeerScript {
public:
    int stepsToSkip() const override { return 120; }
    void create(PeerWorld& world) override {
        constexpr int kColumns = 20;
        constexpr int kRows = 150;
        world.addBody(tub(40, 100));
        const std::array<Vec2, 3> left = {{{-1, 0}, {0.5F, 1}, {0, 2}}};
        const std::array<Vec2, 3> right = {{{1, 0}, {-0.5F, 1}, {0, 2}}};
        double side = 0.25;
        for (int i = 0; i < kColumns; ++i) {
            for (int j = 0; j < kRows; ++j) {
                PeerBody body = dynamicAt(2.0 * i - (kColumns - 1) + side, 2.25 * j + 5.575);
                side = -side;
                for (const auto& points : {left, right}) {
                    body.shapes.push_back({convexHull(points).value()});
                    body.shapes.back().def.friction = 0.5F;
                }
                world.addBody(body);
            }
        }
    }
};

class Smash final : public PeerScript {
public:
    int stepsToSkip() const override { return 75; }
    void create(PeerWorld& world) override {
        world.setGravity({0, 0});
        PeerBody hammer = dynamicAt(-20, 0);
        hammer.def.velocity = {40, 0};
        hammer.shapes.push_back({box(4, 4)});
        hammer.shapes.back().def.density = 8;
        world.addBody(hammer);
        for (int i = 0; i < 120; ++i) {
            for (int j = 0; j < 80; ++j) {
                PeerBody body = dynamicAt(0.4 * i + 30, 0.4 * (j - 40));
                body.def.awake = false;
                body.shapes.push_back({box(0.2F, 0.2F)});
                world.addBody(body);
            }
        }
    }
};

class Spinner final : public PeerScript {
public:
    int stepsToSkip() const override { return 60; }
    void create(PeerWorld& world) override {
        constexpr int kPoints = 360;
        constexpr int kBodies = 6076;
        PeerBody rim = ground();
        for (int i = 0; i < kPoints; ++i) {  // clockwise: solid outside
            rim.loop.push_back(onCircle(40, -2 * kPi * i / kPoints) + Vec2{0, 32});
        }
        rim.loopFriction = 0.1F;
        const std::uint32_t rimBody = world.addBody(rim);
        PeerBody blade = dynamicAt(0, 12);
        blade.shapes.push_back({makeBox({0.4F, 20}, {}, 0, 0.2F).value()});
        blade.shapes.back().def.friction = 0;
        const std::uint32_t bladeBody = world.addBody(blade);
        PeerHinge hinge{rimBody, bladeBody, {0, 12}};
        hinge.motor = AngularMotor{5, 1e9F};
        world.addHinge(hinge);
        const std::array<Polygon, 3> shapes = {makeCapsule({-0.25F, 0}, {0.25F, 0}, 0.25F).value(),
                                               makeCircle({}, 0.35F).value(), box(0.35F, 0.35F)};
        double x = -23;
        double y = 2;
        for (int i = 0; i < kBodies; ++i) {
            PeerBody body = dynamicAt(x, y);
            body.shapes.push_back({shapes[static_cast<std::size_t>(i % 3)]});
            body.shapes.back().def = {.density = 0.25F, .friction = 0.1F, .restitution = 0.1F};
            world.addBody(body);
            x += 0.5;
            if (x >= 23) {
                x = -23;
                y += 0.5;
            }
        }
    }
};

class Tumbler final : public PeerScript {
public:
    int stepsToSkip() const override { return 100; }
    void create(PeerWorld& world) override {
        constexpr int kGrid = 45;
        const std::uint32_t base = world.addBody(ground());
        PeerBody drum = dynamicAt(0, 10);
        for (const Real side : {10.F, -10.F}) {
            drum.shapes.push_back({box(0.5F, 10, {side, 0})});
            drum.shapes.push_back({box(10, 0.5F, {0, side})});
        }
        for (PeerShape& shape : drum.shapes) { shape.def.density = 50; }
        const std::uint32_t drumBody = world.addBody(drum);
        PeerHinge hinge{base, drumBody, {0, 10}};
        hinge.motor = AngularMotor{static_cast<Real>(25 * kPi / 180), 1e8F};
        world.addHinge(hinge);
        for (int i = 0; i < kGrid; ++i) {
            for (int j = 0; j < kGrid; ++j) {
                PeerBody body = dynamicAt(-0.2 * kGrid + 0.4 * j, -0.2 * kGrid + 10 + 0.4 * i);
                body.shapes.push_back({box(0.125F, 0.125F)});
                world.addBody(body);
            }
        }
    }
};

class Washer final : public PeerScript {
public:
    int stepsToSkip() const override { return 60; }
    void create(PeerWorld& world) override {
        constexpr int kGrid = 90;
        constexpr double kHalf = 0.1;
        world.addBody(drum());
        for (int i = 0; i < kGrid; ++i) {
            for (int j = 0; j < kGrid; ++j) {
                PeerBody body = dynamicAt(-1.1 * kHalf * kGrid + 2.1 * kHalf * j, -1.1 * kHalf * kGrid + 10 + 2.1 * kHalf * i);
                body.shapes.push_back({box(static_cast<Real>(kHalf), static_cast<Real>(kHalf))});
                world.addBody(body);
            }
        }
    }

private:
    /// A wheel of 36 blocks, a little wider than their share, with four paddles inside.
    static PeerBody drum() {
        constexpr double kTurn = kPi / 18;
        PeerBody body;
        body.def.type = BodyType::kinematic;
        body.def.position = {0, 10};
        body.def.angularVelocity = static_cast<Real>(25 * kPi / 180);
        body.def.velocity = {0.001F, -0.002F};
        for (int i = 0; i < 36; ++i) {
            const double from = i * kTurn;
            body.shapes.push_back({block(16, 18, from - 0.1 * kTurn, from + 1.1 * kTurn)});
            if (i % 9 == 0) { body.shapes.push_back({block(14, 16, from, from + kTurn)}); }
        }
        return body;
    }
    static Polygon block(double inner, double outer, double from, double to) {
        const std::array<Vec2, 4> points = {onCircle(inner, from), onCircle(outer, from), onCircle(inner, to),
                                            onCircle(outer, to)};
        return convexHull(points).value();
    }
};

class JointGrid final : public PeerScript {
public:
    int stepsToSkip() const override { return 30; }
    void create(PeerWorld& world) override {
        constexpr int kGrid = 100;
        constexpr std::uint32_t kCategory = 2;
        world.setSleep(false);
        std::vector<std::uint32_t> bodies;
        for (int k = 0; k < kGrid; ++k) {
            for (int i = 0; i < kGrid; ++i) {
                PeerBody body = dynamicAt(k, -i);
                if (std::abs(k - kGrid / 2) <= 3 && i == 0) { body.def.type = BodyType::fixed; }
                body.shapes.push_back({makeCircle({}, 0.4F).value()});
                body.shapes.back().def.filter = {kCategory, ~kCategory, 0};
                bodies.push_back(world.addBody(body));
                if (i > 0) { world.addHinge({bodies[bodies.size() - 2], bodies.back(), {k + 0.0, 0.5 - i}}); }
                if (k > 0) { world.addHinge({bodies[bodies.size() - 1 - kGrid], bodies.back(), {k - 0.5, -i + 0.0}}); }
            }
        }
    }
};

class Rain final : public PeerScript {
public:
    int stepsToSkip() const override { return 330; }
    void create(PeerWorld& world) override {
        PeerBody body = ground();
        for (int row = 0; row < kRows; ++row) {
            for (int i = 0; i <= kTiles; ++i) {
                const Vec2 at{static_cast<Real>(kTile * (i - kTiles / 2)), static_cast<Real>(kRowHeight * row)};
                body.shapes.push_back({box(static_cast<Real>(kTile / 2), static_cast<Real>(kTile / 2), at)});
            }
        }
        world.addBody(body);
    }
    void beforeStep(PeerWorld& world, int step) override {
        constexpr int kDelay = 8;
        if (step % kDelay != 0) { return; }
        const int column = step / kDelay % kColumns;
        for (int row = 0; row < kRows; ++row) {
            auto& bodies = groups_[static_cast<std::size_t>(row * kColumns + column)];
            for (const std::uint32_t body : bodies) { world.removeBody(body); }
            bodies.clear();
            const double x = kTile * kTiles * ((column + 0.5) / kColumns - 0.5);
            for (int i = 0; i < kGroupSize; ++i) {
                const auto added = addRagdoll(world, {x + 0.5 * i, 40 + kRowHeight * row}, i + 1);
                bodies.insert(bodies.end(), added.begin(), added.end());
            }
        }
    }

private:
    static constexpr int kRows = 5;
    static constexpr int kColumns = 40;
    static constexpr int kGroupSize = 5;
    static constexpr int kTiles = 500;
    static constexpr double kTile = 0.5;
    static constexpr double kRowHeight = 45;
    std::array<std::vector<std::uint32_t>, kRows * kColumns> groups_;
};

class Junkyard final : public PeerScript {
public:
    int stepsToSkip() const override { return 120; }
    void create(PeerWorld& world) override {
        constexpr int kColumns = 200;
        constexpr int kRowCount = 40;
        constexpr double kRadius = 0.25;
        world.addBody(tub(80, 50));
        std::array<Vec2, 5> points;
        const double golden = kPi * (std::sqrt(5.0) - 1);
        for (std::size_t i = 0; i < points.size(); ++i) { points[i] = onCircle(kRadius, golden * static_cast<double>(i)); }
        const Polygon polygon = convexHull(points).value();
        double side = -0.1;
        for (int i = 0; i < kColumns; ++i) {
            for (int j = 0; j < kRowCount; ++j) {
                PeerBody body = dynamicAt(1.5 * (2.0 * i - kColumns) * kRadius + side, 4 * kRadius * j + 15);
                side = -side;
                body.shapes.push_back({polygon});
                world.addBody(body);
            }
        }
        PeerBody pusher;
        pusher.def.type = BodyType::kinematic;
        pusher.shapes.push_back({box(2, 4, {0, 4})});
        pusher_ = world.addBody(pusher);
    }
    void beforeStep(PeerWorld& world, int step) override {
        const auto placeAt = [](int i) { return 60 * std::sin(0.2 * i / 60.0); };
        world.setVelocity(pusher_, {static_cast<Real>(60 * (placeAt(step) - placeAt(step - 1))), 0});
    }

private:
    std::uint32_t pusher_ = 0;
};

}  // namespace

void PeerScript::beforeStep(PeerWorld&, int) {}

const char* nameOf(PeerScene scene) {
    switch (scene) {
        case PeerScene::compounds: return "compounds";
        case PeerScene::smash: return "smash";
        case PeerScene::spinner: return "spinner";
        case PeerScene::tumbler: return "tumbler";
        case PeerScene::washer: return "washer";
        case PeerScene::jointGrid: return "jointGrid";
        case PeerScene::rain: return "rain";
        case PeerScene::junkyard: return "junkyard";
    }
    return "";  // unreachable, but GCC cannot know
}

std::unique_ptr<PeerScript> makePeerScript(PeerScene scene) {
    switch (scene) {
        case PeerScene::compounds: return std::make_unique<Compounds>();
        case PeerScene::smash: return std::make_unique<Smash>();
        case PeerScene::spinner: return std::make_unique<Spinner>();
        case PeerScene::tumbler: return std::make_unique<Tumbler>();
        case PeerScene::washer: return std::make_unique<Washer>();
        case PeerScene::jointGrid: return std::make_unique<JointGrid>();
        case PeerScene::rain: return std::make_unique<Rain>();
        case PeerScene::junkyard: return std::make_unique<Junkyard>();
    }
    return nullptr;  // unreachable, but GCC cannot know
}

}  // namespace swept::bench
