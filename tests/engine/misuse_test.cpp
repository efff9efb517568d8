#include <array>
#include <set>

#include <swept/shapes/hull.h>

#include "../support/random.h"
#include "world_digest.h"
#include "world_support.h"

/// Random calls of everything that a world offers, most of them nonsense: the world says no, stays as it was, and goes on.

namespace swept::test {
namespace {

/// How large the numbers may be that are finite and hence hard to refuse.
enum class Sizes { usual, extreme };

class Vandal {
public:
    Vandal(std::uint64_t seed, Sizes sizes) : random_(seed), sizes_(sizes), world_(makeWorld()) {
        // Ids of another world: some of them name nothing here, others the wrong thing, as far as anyone can tell.
        for (std::uint32_t i = 0; i < 8; ++i) {
            known_.bodies.push_back({i * 5, 1 + i % 3});
            known_.shapes.push_back({i * 5, 1 + i % 3});
            known_.joints.push_back({i, 1 + i % 3});
        }
        known_.bodies.push_back({});
        known_.shapes.push_back({});
        known_.joints.push_back({});
        digest_ = digestOf(world_, known_);
    }

    void act() {
        const int choice = random_.integer(0, 29);
        if (choice < 4) { return note(makeBody()); }
        if (choice < 8) { return note(makeShape()); }
        if (choice < 9) { return note(makeChain()); }
        if (choice < 11) { return note(makeJoint()); }
        if (choice < 16) { return note(pushBody()); }
        if (choice < 20) { return note(destroySomething()); }
        if (choice < 21) { return note(changeSettings()); }
        if (choice < 23) { return ask(); }
        if (choice < 24) { return note(world_.step(wild())); }
        removeMassless();
        return note(world_.step(kStep));
    }

    World& world() { return world_; }
    const KnownIds& known() const { return known_; }
    int calls() const { return calls_; }
    int refusals() const { return refusals_; }
    int steps() const { return steps_; }
    const std::array<int, 16>& codes() const { return codes_; }

    /// The first body whose state is no number, if any.
    bool allFinite() const {
        for (const BodyId id : known_.bodies) {
            const bool good = isFinite(world_.position(id)) && isFinite(world_.velocity(id)) &&
                              isFinite(world_.angularVelocity(id)) && std::isfinite(world_.angle(id));
            if (!good) { return false; }
        }
        return true;
    }
    std::uint32_t livingBodies() const {
        std::set<std::uint32_t> slots;  // an invented id may be that of a body made later
        for (const BodyId id : known_.bodies) {
            if (world_.isValid(id)) { slots.insert(id.index); }
        }
        return static_cast<std::uint32_t>(slots.size());
    }

private:
    // --- numbers
    double tame() { return random_.range(-4, 4); }
    double huge() { return sizes_ == Sizes::usual ? random_.range(-1e4, 1e4) : 0x1p120 * random_.range(-1, 1); }
    double wild() {
        constexpr auto kMax = static_cast<double>(std::numeric_limits<Real>::max());
        const double large = sizes_ == Sizes::usual ? 1e5 : kMax;
        const std::array<double, 9> odd{std::nan(""), 1 / 0.0, -1 / 0.0, large,    -large,
                                        0,            -1,      1e-30,    huge()};
        return odd[static_cast<std::size_t>(random_.integer(0, 8))];
    }
    double number() { return random_.chance(0.94) ? tame() : wild(); }
    double positive() { return random_.chance(0.94) ? random_.range(0.1, 2) : wild(); }
    Real realNumber() { return static_cast<Real>(number()); }
    Real realPositive() { return static_cast<Real>(positive()); }
    Vec2 vector() { return {realNumber(), realNumber()}; }
    DVec2 place() { return {number(), number()}; }

    // --- ids
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

    // --- calls
    Status makeBody() {
        BodyDef def;
        def.type = static_cast<BodyType>(random_.integer(0, random_.chance(0.05) ? 200 : 2));
        def.position = place();
        def.angle = number();
        if (def.type != BodyType::fixed || random_.chance(0.1)) {
            def.velocity = vector();
            def.angularVelocity = realNumber();
        }
        if (random_.chance(0.1)) { def.linearDamping = realNumber(); }
        if (random_.chance(0.1)) { def.angularDamping = realNumber(); }
        if (random_.chance(0.1)) { def.gravityScale = realNumber(); }
        if (random_.chance(0.3)) { def.mass = realPositive(); }
        if (random_.chance(0.1)) { def.inertia = realPositive(); }
        def.fixedRotation = random_.chance(0.1);
        def.awake = random_.chance(0.9);
        if (random_.chance(0.2)) { def.continuous = static_cast<ContinuousMode>(random_.integer(0, 5)); }
        const Result<BodyId> id = world_.createBody(def);
        if (!id.ok()) { return id.status(); }
        known_.bodies.push_back(id.value());
        if (random_.chance(0.8)) { (void)world_.addShape(id.value(), good()); }
        return id.status();
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
        return def;
    }
    template <class Id>
    static Status remember(const Result<Id>& id, std::vector<Id>& ids) {
        if (id.ok()) { ids.push_back(id.value()); }
        return id.status();
    }
    Status makeShape() { return remember(world_.addShape(any(known_.bodies), polygon(), surface()), known_.shapes); }
    Status makeChain() {
        std::vector<Vec2> points;
        const int count = random_.integer(0, 6);
        for (int i = 0; i < count; ++i) { points.push_back(vector()); }
        const Real radius = random_.chance(0.7) ? Real(0) : realPositive();
        return remember(world_.addChain(any(known_.bodies), points, random_.chance(0.3), surface(), radius),
                        known_.shapes);
    }
    JointDef anyBodies() {
        JointDef def{.bodyA = any(known_.bodies), .bodyB = any(known_.bodies)};
        def.collideConnected = random_.chance(0.3);
        if (random_.chance(0.2)) { def.breakForce = realPositive(); }
        if (random_.chance(0.2)) { def.breakTorque = realPositive(); }
        return def;
    }
    std::optional<Spring> anySpring() {
        return random_.chance(0.3) ? std::optional<Spring>({realPositive(), realPositive()}) : std::nullopt;
    }
    Status makeJoint() {
        if (random_.chance(0.5)) {
            RevoluteJointDef def{.base = anyBodies(), .anchor = place()};
            if (random_.chance(0.3)) { def.limits = {realNumber(), realNumber()}; }
            if (random_.chance(0.3)) { def.motor = {realNumber(), realNumber()}; }
            def.spring = anySpring();
            return remember(world_.createJoint(def), known_.joints);
        }
        DistanceJointDef def{.base = anyBodies(), .anchorA = place(), .anchorB = place()};
        if (random_.chance(0.3)) { def.length = realNumber(); }
        if (random_.chance(0.3)) { def.limits = {realNumber(), realNumber()}; }
        def.spring = anySpring();
        return remember(world_.createJoint(def), known_.joints);
    }
    Status pushBody() {
        const BodyId body = any(known_.bodies);
        switch (random_.integer(0, 5)) {
            case 0: return world_.setPose(body, place(), number());
            case 1: return world_.setVelocity(body, vector(), realNumber());
            case 2: return world_.applyForce(body, vector(), place());
            case 3: return world_.applyTorque(body, realNumber());
            case 4: return world_.applyImpulse(body, vector(), place());
            default: return world_.setAwake(body, random_.chance(0.5));
        }
    }
    Status destroySomething() {
        // Not too crowded: most of the time goes into calls, not into steps.
        if (world_.bodyCount() > 10 || random_.chance(0.2)) { return world_.destroyBody(any(known_.bodies)); }
        if (random_.chance(0.5)) { return world_.destroyShape(any(known_.shapes)); }
        return world_.destroyJoint(any(known_.joints));
    }
    Status changeSettings() {
        WorldSettings settings;
        settings.gravity = vector();
        settings.profile = static_cast<Profile>(random_.integer(0, random_.chance(0.1) ? 200 : 1));
        settings.subSteps = random_.chance(0.1) ? random_.integer(-5, 2000) : random_.integer(0, 8);
        settings.relaxPasses = random_.integer(-3, 3);
        settings.continuous = static_cast<ContinuousMode>(random_.integer(0, random_.chance(0.1) ? 200 : 4));
        settings.maxImpacts = random_.integer(-1, 12);
        if (random_.chance(0.1)) { settings.maxSpeed = realPositive(); }
        if (random_.chance(0.1)) { settings.toiTolerance = realPositive(); }
        if (random_.chance(0.1)) { settings.maxPenetration = realPositive(); }
        if (random_.chance(0.1)) { settings.maxJointError = realPositive(); }
        if (random_.chance(0.1)) { settings.maxLostTime = random_.range(-0.01, 0.1); }
        settings.sleep = random_.chance(0.8);
        settings.broadphase = static_cast<BroadphaseKind>(random_.integer(0, random_.chance(0.1) ? 200 : kBroadphaseKindCount - 1));
        return world_.configure(settings);
    }
    void ask() {
        (void)world_.castRay(place(), vector());
        (void)world_.castShape(polygon(), {place(), rotationFromAngle(random_.range(-4, 4))}, vector());
        world_.queryBox({vector(), vector()}, {}, [](ShapeId) { return true; });
        world_.overlapShape(polygon(), {place(), {}}, {}, [](ShapeId) { return true; });
        const JointId joint = any(known_.joints);
        (void)world_.jointError(joint);
        (void)world_.bodyOf(any(known_.shapes));
        ASSERT_EQ(digestOf(world_, known_), digest_) << "a question changed the world";
        ++calls_;
    }
    /// A body without mass makes the world refuse all steps: seen often enough, but not all the time.
    void removeMassless() {
        if (random_.chance(0.1)) { return; }
        for (const BodyId id : known_.bodies) {
            if (world_.type(id) == BodyType::dynamic && !(world_.mass(id) > 0)) { (void)world_.destroyBody(id); }
        }
        digest_ = digestOf(world_, known_);
    }

    void note(Status status) {
        ++calls_;
        const std::uint64_t now = digestOf(world_, known_);
        ++codes_[static_cast<std::size_t>(status.code)];
        if (!status.ok()) {
            ++refusals_;
            ASSERT_STRNE(status.field, "") << describe(status.code);
            ASSERT_EQ(now, digest_) << "refused, yet changed: " << status.field << ' ' << describe(status.code);
        }
        forget();
        digest_ = digestOf(world_, known_);
    }
    /// Old names are kept, but not all of them for ever.
    void forget() {
        const auto trim = [](auto& ids, auto alive) {
            if (ids.size() < 80) { return; }
            std::size_t dead = 0;
            std::erase_if(ids, [&](auto id) { return !alive(id) && dead++ % 2 == 0; });
        };
        trim(known_.bodies, [this](BodyId id) { return world_.isValid(id); });
        trim(known_.shapes, [this](ShapeId id) { return world_.isValid(id); });
        trim(known_.joints, [this](JointId id) { return world_.isValid(id); });
        steps_ += world_.counters().awakeBodies > 0 ? 1 : 0;
    }

    Random random_;
    Sizes sizes_;
    World world_;
    KnownIds known_;
    std::uint64_t digest_ = 0;
    int calls_ = 0;
    int refusals_ = 0;
    int steps_ = 0;
    std::array<int, 16> codes_{};
};

/// What is left can be cleared away, and then a ball falls as in a new world.
void expectUsable(Vandal& vandal) {
    World& world = vandal.world();
    ASSERT_EQ(world.bodyCount(), vandal.livingBodies());
    for (const BodyId id : vandal.known().bodies) {
        if (world.isValid(id)) { must(world.destroyBody(id)); }
    }
    EXPECT_EQ(world.bodyCount(), 0u);
    EXPECT_EQ(world.jointCount(), 0u);
    must(world.step(kStep));
    EXPECT_EQ(world.counters().contacts, 0u);
    EXPECT_EQ(world.counters().awakeBodies, 0u);
    for (const ShapeId id : vandal.known().shapes) { EXPECT_FALSE(world.isValid(id)); }
    must(world.configure(awakeSettings()));
    addStatic(world, box(20, 1));
    const BodyId ball = addBody(world, dynamicAt({0, 4}), circle(0.5));
    run(world, 10);
    EXPECT_NEAR(velocityOf(world, ball).y, -kGravity * 10 * kStep, 1e-5);
    run(world, 200);
    EXPECT_NEAR(world.position(ball).y, 1.5, 0.005);
    EXPECT_NEAR(velocityOf(world, ball).y, 0, 0.005);
}

void vandalise(Sizes sizes, int seeds, int actions) {
    int refusals = 0;
    int calls = 0;
    std::array<int, 16> codes{};
    for (int seed = 0; seed < seeds; ++seed) {
        Vandal vandal(static_cast<std::uint64_t>(seed), sizes);
        for (int i = 0; i < actions; ++i) {
            vandal.act();
            ASSERT_TRUE(vandal.allFinite()) << "seed " << seed << " action " << i;
            if (testing::Test::HasFatalFailure()) { FAIL() << "seed " << seed << " action " << i; }
        }
        expectUsable(vandal);
        if (testing::Test::HasFailure()) { FAIL() << "seed " << seed; }
        refusals += vandal.refusals();
        calls += vandal.calls();
        for (std::size_t c = 0; c < codes.size(); ++c) { codes[c] += vandal.codes()[c]; }
    }
    EXPECT_GT(refusals, calls / 5);
    EXPECT_GT(codes[0], calls / 5);
    for (const StatusCode code : {StatusCode::notFinite, StatusCode::negative, StatusCode::notPositive,
                                  StatusCode::outOfRange, StatusCode::staleId, StatusCode::degenerate,
                                  StatusCode::notConvex, StatusCode::tooFewVertices, StatusCode::tooManyVertices,
                                  StatusCode::wrongBodyType, StatusCode::missingMass, StatusCode::sameBody}) {
        EXPECT_GT(codes[static_cast<std::size_t>(code)], 0) << describe(code) << " was never the answer";
    }
}

TEST(Misuse, LeavesAUsableWorld) { vandalise(Sizes::usual, SWEPT_MISUSE_PROGRAMS, 1'250); }

/// Finite, but so large that sums and products of them are not.
TEST(Misuse, ExtremeNumbersToo) { vandalise(Sizes::extreme, SWEPT_MISUSE_PROGRAMS, 1'250); }

}  // namespace
}  // namespace swept::test
