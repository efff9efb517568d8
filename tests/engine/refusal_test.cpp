#include <functional>

#include <swept/shapes/chain.h>

#include "world_digest.h"
#include "world_support.h"

/// What is refused, and with which code and field; a refused call leaves the world as it was.

namespace swept::test {
namespace {

constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
constexpr double kNanDouble = std::numeric_limits<double>::quiet_NaN();

/// A world with one of everything, and names of things that are gone.
struct Stage {
    World world;
    BodyId ground, cart, crate, ball, goneBody;
    ShapeId chain, box, goneShape;
    JointId hinge, goneJoint;
    KnownIds known;

    Stage() : world(makeWorld()) {
        ground = must(world.createBody(bodyAt(BodyType::fixed, {0, 0})));
        const std::vector<Vec2> points{vec(10, 0), vec(0, 0), vec(-10, 0)};
        chain = must(world.addChain(ground, points, false));
        cart = addBody(world, bodyAt(BodyType::kinematic, {-5, 2}), test::box(1, 0.25));
        crate = must(world.createBody(bodyAt(BodyType::dynamic, {0, 0.5})));
        box = must(world.addShape(crate, test::box(0.5, 0.5)));
        ball = addBody(world, bodyAt(BodyType::dynamic, {2, 2}), circle(0.25));
        // Aside, or the ball would hang still, to the last bit.
        hinge = must(world.createJoint(RevoluteJointDef{.base = {.bodyA = cart, .bodyB = ball}, .anchor = {2.5, 3}}));
        goneBody = must(world.createBody({}));
        goneShape = must(world.addShape(goneBody, circle(1)));
        goneJoint = must(world.createJoint(
            DistanceJointDef{.base = {.bodyA = crate, .bodyB = ball}, .anchorA = {0, 1}, .anchorB = {2, 2}}));
        must(world.destroyJoint(goneJoint));
        must(world.destroyBody(goneBody));
        run(world, 10);
        known = {{ground, cart, crate, ball, goneBody}, {chain, box, goneShape}, {hinge, goneJoint}};
    }
};

struct Case {
    const char* name;
    std::function<Status(Stage&)> call;
    StatusCode code;
    const char* field;
};

void expectRefusals(const std::vector<Case>& cases) {
    Stage stage;
    const std::uint64_t before = digestOf(stage.world, stage.known);
    for (const Case& c : cases) {
        const Status status = c.call(stage);
        EXPECT_EQ(status.code, c.code) << c.name << ": " << describe(status.code);
        EXPECT_STREQ(status.field, c.field) << c.name;
        ASSERT_EQ(digestOf(stage.world, stage.known), before) << c.name << " changed the world";
    }
    must(stage.world.step(kStep));
    EXPECT_NE(digestOf(stage.world, stage.known), before) << "the digest sees what happens";
}

/// A case that changes one member of a valid definition.
template <class Change>
auto withBody(Change change) {
    return [change](Stage& s) {
        BodyDef def = bodyAt(BodyType::dynamic, {0, 5});
        change(def);
        return s.world.createBody(def).status();
    };
}
template <class Change>
auto withShape(Change change) {
    return [change](Stage& s) {
        ShapeDef def;
        Polygon polygon = test::box(1, 1);
        change(def, polygon);
        return s.world.addShape(s.crate, polygon, def).status();
    };
}
template <class Change>
auto withSettings(Change change) {
    return [change](Stage& s) {
        WorldSettings settings = s.world.settings();
        change(settings);
        return s.world.configure(settings);
    };
}
template <class Change>
auto withHinge(Change change) {
    return [change](Stage& s) {
        RevoluteJointDef def{.base = {.bodyA = s.ground, .bodyB = s.crate}, .anchor = {0, 1}};
        change(def, s);
        return s.world.createJoint(def).status();
    };
}
template <class Change>
auto withRod(Change change) {
    return [change](Stage& s) {
        DistanceJointDef def{.base = {.bodyA = s.ground, .bodyB = s.crate}, .anchorA = {0, 3}, .anchorB = {0, 1}};
        change(def, s);
        return s.world.createJoint(def).status();
    };
}
auto withChain(std::vector<Vec2> points, bool loop, Real radius) {
    return [=](Stage& s) { return s.world.addChain(s.ground, points, loop, {}, radius).status(); };
}

auto withNeighbours(bool loop, const ChainNeighbours& neighbours) {
    return [=](Stage& s) {
        const std::vector<Vec2> three{vec(1, 0), vec(0, 0), vec(0, 1)};
        return s.world.addChain(s.ground, three, loop, {}, 0, neighbours).status();
    };
}

TEST(Refusal, Bodies) {
    expectRefusals({
        {"position", withBody([](BodyDef& d) { d.position.x = kNanDouble; }), StatusCode::notFinite, "position"},
        {"angle", withBody([](BodyDef& d) { d.angle = -1 / 0.0; }), StatusCode::notFinite, "angle"},
        {"velocity", withBody([](BodyDef& d) { d.velocity.y = kInfinity; }), StatusCode::notFinite, "velocity"},
        {"spin", withBody([](BodyDef& d) { d.angularVelocity = kNan; }), StatusCode::notFinite, "angularVelocity"},
        {"damping", withBody([](BodyDef& d) { d.linearDamping = -1; }), StatusCode::negative, "linearDamping"},
        {"damping of spin", withBody([](BodyDef& d) { d.angularDamping = kNan; }), StatusCode::notFinite,
         "angularDamping"},
        {"scale", withBody([](BodyDef& d) { d.gravityScale = kInfinity; }), StatusCode::notFinite, "gravityScale"},
        {"mass", withBody([](BodyDef& d) { d.mass = -2; }), StatusCode::negative, "mass"},
        {"inertia", withBody([](BodyDef& d) { d.inertia = -2; }), StatusCode::negative, "inertia"},
        {"moving wall", withBody([](BodyDef& d) { d.type = BodyType::fixed, d.velocity.x = 1; }),
         StatusCode::wrongBodyType, "velocity"},
        {"no such type", withBody([](BodyDef& d) { d.type = static_cast<BodyType>(9); }), StatusCode::outOfRange,
         "type"},
        {"no such mode", withBody([](BodyDef& d) { d.continuous = static_cast<ContinuousMode>(77); }),
         StatusCode::outOfRange, "continuous"},
    });
}

TEST(Refusal, CallsOnBodies) {
    expectRefusals({
        {"stale destroy", [](Stage& s) { return s.world.destroyBody(s.goneBody); }, StatusCode::staleId, "body"},
        {"null destroy", [](Stage& s) { return s.world.destroyBody({}); }, StatusCode::staleId, "body"},
        {"stale pose", [](Stage& s) { return s.world.setPose(s.goneBody, {}, 0); }, StatusCode::staleId, "body"},
        {"pose",
         [](Stage& s) {
             return s.world.setPose(s.crate, {0, kNanDouble}, 0);
         },
         StatusCode::notFinite, "position"},
        {"pose angle", [](Stage& s) { return s.world.setPose(s.crate, {}, kNanDouble); }, StatusCode::notFinite,
         "angle"},
        {"moving wall", [](Stage& s) { return s.world.setVelocity(s.ground, {}, 0); }, StatusCode::wrongBodyType,
         "body"},
        {"velocity",
         [](Stage& s) {
             return s.world.setVelocity(s.ball, {kNan, 0}, 0);
         },
         StatusCode::notFinite, "velocity"},
        {"spin", [](Stage& s) { return s.world.setVelocity(s.ball, {}, kInfinity); }, StatusCode::notFinite,
         "angularVelocity"},
        {"pushed cart",
         [](Stage& s) {
             return s.world.applyForce(s.cart, {1, 0}, {});
         },
         StatusCode::wrongBodyType, "body"},
        {"force",
         [](Stage& s) {
             return s.world.applyForce(s.ball, {kNan, 0}, {});
         },
         StatusCode::notFinite, "force"},
        {"point",
         [](Stage& s) {
             return s.world.applyForce(s.ball, {}, {kNanDouble, 0});
         },
         StatusCode::notFinite, "point"},
        {"torque", [](Stage& s) { return s.world.applyTorque(s.ball, kNan); }, StatusCode::notFinite, "torque"},
        {"impulse",
         [](Stage& s) {
             return s.world.applyImpulse(s.ball, {0, kNan}, {});
         },
         StatusCode::notFinite, "impulse"},
        {"stale impulse", [](Stage& s) { return s.world.applyImpulse(s.goneBody, {}, {}); }, StatusCode::staleId,
         "body"},
        {"sleeping wall", [](Stage& s) { return s.world.setAwake(s.ground, false); }, StatusCode::wrongBodyType,
         "body"},
        {"stale sleeper", [](Stage& s) { return s.world.setAwake(s.goneBody, true); }, StatusCode::staleId, "body"},
    });
}

TEST(Refusal, Shapes) {
    expectRefusals({
        {"stale body", [](Stage& s) { return s.world.addShape(s.goneBody, circle(1)).status(); }, StatusCode::staleId,
         "body"},
        {"density", withShape([](ShapeDef& d, Polygon&) { d.density = kNan; }), StatusCode::notFinite, "density"},
        {"density below 0", withShape([](ShapeDef& d, Polygon&) { d.density = -1; }), StatusCode::negative, "density"},
        {"friction", withShape([](ShapeDef& d, Polygon&) { d.friction = -1; }), StatusCode::negative, "friction"},
        {"restitution", withShape([](ShapeDef& d, Polygon&) { d.restitution = 2; }), StatusCode::outOfRange,
         "restitution"},
        {"friction mixing", withShape([](ShapeDef& d, Polygon&) { d.frictionMixing = static_cast<MixingRule>(6); }),
         StatusCode::outOfRange, "frictionMixing"},
        {"restitution mixing",
         withShape([](ShapeDef& d, Polygon&) { d.restitutionMixing = static_cast<MixingRule>(255); }),
         StatusCode::outOfRange, "restitutionMixing"},
        {"nothing", withShape([](ShapeDef&, Polygon& p) { p = {}; }), StatusCode::tooFewVertices, "count"},
        {"count", withShape([](ShapeDef&, Polygon& p) { p.count = 9; }), StatusCode::tooManyVertices, "count"},
        {"radius", withShape([](ShapeDef&, Polygon& p) { p.radius = -1; }), StatusCode::negative, "radius"},
        {"vertex", withShape([](ShapeDef&, Polygon& p) { p.vertices[2].x = kNan; }), StatusCode::notFinite, "vertices"},
        {"clockwise", withShape([](ShapeDef&, Polygon& p) { std::swap(p.vertices[1], p.vertices[3]); }),
         StatusCode::notConvex, "vertices"},
        {"line", withShape([](ShapeDef&, Polygon& p) { p.count = 2, p.vertices[1] = p.vertices[0]; }),
         StatusCode::degenerate, "vertices"},
        {"normals", withShape([](ShapeDef&, Polygon& p) {
             p.normals[0] = {1, 0};
         }),
         StatusCode::outOfRange, "normals"},
        {"gone", [](Stage& s) { return s.world.destroyShape(s.goneShape); }, StatusCode::staleId, "shape"},
        {"null", [](Stage& s) { return s.world.destroyShape({}); }, StatusCode::staleId, "shape"},
        {"inner part of a chain",
         [](Stage& s) {
             return s.world.destroyShape({s.chain.index + 1, s.chain.generation});
         },
         StatusCode::staleId, "shape"},
    });
}

TEST(Refusal, Chains) {
    const std::vector<Vec2> two{vec(1, 0), vec(0, 0)};
    expectRefusals({
        {"dynamic", [two](Stage& s) { return s.world.addChain(s.crate, two, false).status(); },
         StatusCode::wrongBodyType, "body"},
        {"stale", [two](Stage& s) { return s.world.addChain(s.goneBody, two, false).status(); }, StatusCode::staleId,
         "body"},
        {"empty", withChain({}, false, 0), StatusCode::tooFewVertices, "points"},
        {"point", withChain({vec(0, 0)}, false, 0), StatusCode::tooFewVertices, "points"},
        {"loop of two", withChain(two, true, 0), StatusCode::tooFewVertices, "points"},
        {"twice the same", withChain({vec(0, 0), vec(0, 0)}, false, 0), StatusCode::degenerate, "points"},
        {"number", withChain({{kNan, 0}, vec(0, 0)}, false, 0), StatusCode::notFinite, "points"},
        {"radius", withChain(two, false, -1), StatusCode::negative, "radius"},
        {"number before", withNeighbours(false, {.before = Vec2{kNan, 0}}), StatusCode::notFinite, "before"},
        {"number after", withNeighbours(false, {.after = Vec2{kInfinity, 0}}), StatusCode::notFinite, "after"},
        {"far", withNeighbours(false, {.after = Vec2{std::numeric_limits<Real>::max(), 0}}), StatusCode::outOfRange,
         "after"},
        {"the end itself before", withNeighbours(false, {.before = vec(1, 0)}), StatusCode::degenerate, "before"},
        {"the end itself after", withNeighbours(false, {.after = vec(0, 1)}), StatusCode::degenerate, "after"},
        {"of a loop", withNeighbours(true, {.before = vec(3, 3)}), StatusCode::outOfRange, "before"},
    });
}

TEST(Refusal, Joints) {
    expectRefusals({
        {"stale A", withHinge([](auto& d, Stage& s) { d.base.bodyA = s.goneBody; }), StatusCode::staleId, "bodyA"},
        {"null B", withHinge([](auto& d, Stage&) { d.base.bodyB = {}; }), StatusCode::staleId, "bodyB"},
        {"itself", withHinge([](auto& d, Stage&) { d.base.bodyA = d.base.bodyB; }), StatusCode::notDistinct, "bodyB"},
        {"nothing dynamic", withHinge([](auto& d, Stage& s) { d.base.bodyB = s.cart; }), StatusCode::wrongBodyType,
         "bodyB"},
        {"anchor", withHinge([](auto& d, Stage&) { d.anchor.x = kNanDouble; }), StatusCode::notFinite, "anchor"},
        {"force", withHinge([](auto& d, Stage&) { d.base.breakForce = Real(0); }), StatusCode::notPositive,
         "breakForce"},
        {"torque", withHinge([](auto& d, Stage&) { d.base.breakTorque = kNan; }), StatusCode::notFinite, "breakTorque"},
        {"limits", withHinge([](auto& d, Stage&) {
             d.limits = {1, -1};
         }),
         StatusCode::outOfRange, "upper"},
        {"motor", withHinge([](auto& d, Stage&) {
             d.motor = {1, -1};
         }),
         StatusCode::negative, "maxMotorTorque"},
        {"spring", withHinge([](auto& d, Stage&) {
             d.spring = {0, 1};
         }),
         StatusCode::notPositive, "hertz"},
        {"damping", withHinge([](auto& d, Stage&) {
             d.spring = {1, -1};
         }),
         StatusCode::negative, "dampingRatio"},
        {"rod anchor", withRod([](auto& d, Stage&) { d.anchorB.y = kNanDouble; }), StatusCode::notFinite, "anchorB"},
        {"rod of no length", withRod([](auto& d, Stage&) { d.anchorB = d.anchorA; }), StatusCode::notPositive,
         "length"},
        {"length", withRod([](auto& d, Stage&) { d.length = kNan; }), StatusCode::notFinite, "length"},
        {"shortest", withRod([](auto& d, Stage&) {
             d.limits = {-1, 1};
         }),
         StatusCode::negative, "minLength"},
        {"longest", withRod([](auto& d, Stage&) {
             d.limits = {2, 1};
         }),
         StatusCode::outOfRange, "maxLength"},
        {"gone", [](Stage& s) { return s.world.destroyJoint(s.goneJoint); }, StatusCode::staleId, "joint"},
    });
}

TEST(Refusal, SettingsAndSteps) {
    expectRefusals({
        {"gravity", withSettings([](WorldSettings& s) { s.gravity.x = kNan; }), StatusCode::notFinite, "gravity"},
        {"sub-steps", withSettings([](WorldSettings& s) { s.subSteps = 1025; }), StatusCode::outOfRange, "subSteps"},
        {"no sub-steps", withSettings([](WorldSettings& s) { s.subSteps = 0; }), StatusCode::outOfRange, "subSteps"},
        {"no tolerance", withSettings([](WorldSettings& s) { s.toiTolerance = Real(0); }), StatusCode::notPositive,
         "toiTolerance"},
        {"passes", withSettings([](WorldSettings& s) { s.relaxPasses = -1; }), StatusCode::outOfRange, "relaxPasses"},
        {"impacts", withSettings([](WorldSettings& s) { s.maxImpacts = 0; }), StatusCode::outOfRange, "maxImpacts"},
        {"speed", withSettings([](WorldSettings& s) { s.maxSpeed = 0; }), StatusCode::notPositive, "maxSpeed"},
        {"no speed", withSettings([](WorldSettings& s) { s.maxSpeed = kNan; }), StatusCode::notFinite, "maxSpeed"},
        {"tolerance", withSettings([](WorldSettings& s) { s.toiTolerance = Real(-1); }), StatusCode::notPositive,
         "toiTolerance"},
        {"penetration", withSettings([](WorldSettings& s) { s.maxPenetration = kNan; }), StatusCode::notFinite,
         "maxPenetration"},
        {"less than none", withSettings([](WorldSettings& s) { s.maxPenetration = -1; }), StatusCode::negative,
         "maxPenetration"},
        {"joint error", withSettings([](WorldSettings& s) { s.maxJointError = kNan; }), StatusCode::notFinite,
         "maxJointError"},
        {"negative joint error", withSettings([](WorldSettings& s) { s.maxJointError = -1; }), StatusCode::negative,
         "maxJointError"},
        {"sleep speed", withSettings([](WorldSettings& s) { s.sleepSpeed = kInfinity; }), StatusCode::notFinite,
         "sleepSpeed"},
        {"negative sleep speed", withSettings([](WorldSettings& s) { s.sleepSpeed = -1; }), StatusCode::negative,
         "sleepSpeed"},
        {"lost time", withSettings([](WorldSettings& s) { s.maxLostTime = kNan; }), StatusCode::notFinite,
         "maxLostTime"},
        {"negative lost time", withSettings([](WorldSettings& s) { s.maxLostTime = -1; }), StatusCode::negative,
         "maxLostTime"},
        {"busy", withSettings([](WorldSettings& s) { s.broadphase = BroadphaseKind::allPairs; }), StatusCode::notNow,
         "broadphase"},
        {"no such broadphase", withSettings([](WorldSettings& s) { s.broadphase = static_cast<BroadphaseKind>(9); }),
         StatusCode::outOfRange, "broadphase"},
        {"no such profile", withSettings([](WorldSettings& s) { s.profile = static_cast<Profile>(9); }),
         StatusCode::outOfRange, "profile"},
        {"no such mode", withSettings([](WorldSettings& s) { s.continuous = static_cast<ContinuousMode>(9); }),
         StatusCode::outOfRange, "continuous"},
        {"no dt", [](Stage& s) { return s.world.step(0); }, StatusCode::notPositive, "dt"},
        {"dt backwards", [](Stage& s) { return s.world.step(-kStep); }, StatusCode::notPositive, "dt"},
        {"dt", [](Stage& s) { return s.world.step(kNanDouble); }, StatusCode::notFinite, "dt"},
        {"endless dt", [](Stage& s) { return s.world.step(1 / 0.0); }, StatusCode::notFinite, "dt"},
    });
}

TEST(Refusal, StepWithoutMass) {
    World world = makeWorld();
    const BodyId empty = must(world.createBody(bodyAt(BodyType::dynamic, {0, 0})));
    EXPECT_EQ(world.step(kStep).code, StatusCode::missingMass);
    must(world.addShape(empty, circle(1)));
    must(world.step(kStep));
    const BodyId given = must(world.createBody({.type = BodyType::dynamic, .mass = 1}));
    must(world.step(kStep));
    must(world.destroyBody(given));
    must(world.destroyBody(empty));
    must(world.step(kStep));
}

TEST(Refusal, NothingInAnEmptyBroadphase) {
    World world;
    WorldSettings settings;
    settings.broadphase = static_cast<BroadphaseKind>(9);
    EXPECT_EQ(world.configure(settings).code, StatusCode::outOfRange);
    settings.broadphase = BroadphaseKind::allPairs;
    must(world.configure(settings));
    addStatic(world, box(10, 1));
    const BodyId ball = addBody(world, dynamicAt({0, 2}), circle(0.5));
    run(world, 60);
    EXPECT_NEAR(world.position(ball).y, 1.5, 0.02);
}

/// Getters and queries have nothing to refuse with: they answer with nothing.
TEST(Refusal, GettersOfWhatIsGoneAreZero) {
    Stage s;
    EXPECT_FALSE(s.world.isValid(s.goneBody) || s.world.isValid(s.goneShape) || s.world.isValid(s.goneJoint));
    EXPECT_EQ(s.world.position(s.goneBody), DVec2{});
    EXPECT_EQ(s.world.velocity(s.goneBody), Vec2{});
    EXPECT_EQ(s.world.mass(s.goneBody), 0);
    EXPECT_FALSE(s.world.isAwake(s.goneBody));
    EXPECT_EQ(s.world.bodyOf(s.goneShape), BodyId{});
    EXPECT_EQ(s.world.jointForce(s.goneJoint), Vec2{});
    EXPECT_FALSE(s.world.castRay({0, kNanDouble}, vec(0, -5)).hit);
    EXPECT_FALSE(s.world.castRay({0, 5}, {0, kNan}).hit);
    EXPECT_FALSE(s.world.castRay({0, 5}, {0, 0}).hit);
    EXPECT_FALSE(s.world.castShape({}, {}, vec(0, -5)).hit);
    const auto never = [](ShapeId) {
        ADD_FAILURE() << "visited";
        return true;
    };
    s.world.queryBox({{1, 1}, {-1, -1}}, {}, never);
    s.world.overlapShape({}, {}, {}, never);
    for (const Real bad : {kNan, std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()}) {
        for (const Rotation rotation : {Rotation{bad, 0}, Rotation{1, bad}, Rotation{bad, bad}}) {
            EXPECT_FALSE(s.world.castShape(box(50, 50), {{}, rotation}, vec(0, -5)).hit);
            s.world.overlapShape(box(50, 50), {{}, rotation}, {}, never);
        }
    }
}

}  // namespace
}  // namespace swept::test
