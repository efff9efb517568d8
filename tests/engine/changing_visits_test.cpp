#include <array>
#include <functional>
#include <set>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// What queries and visits call back changes the world that they go through.

namespace swept::test {
namespace {

constexpr int kBodies = 30;

/// Bodies of two shapes each, some of them hinged in pairs, fallen down in a chamber of chains with a sensor.
struct Heap {
    World world;
    BodyId walls;
    ShapeId chain;
    ShapeId sensor;
    std::vector<BodyId> bodies;

    explicit Heap(std::uint64_t seed) {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        world = makeWorld(settings);
        walls = must(world.createBody({}));
        const std::array corners{vec(-5, -5), vec(-5, 5), vec(5, 5), vec(5, -5)};  // clockwise: solid outside
        chain = must(world.addChain(walls, corners, true, material(0.5)));
        ShapeDef seen;
        seen.sensor = true;
        sensor = must(world.addShape(walls, box(5, 4), seen));
        Random random(seed);
        for (int i = 0; i < kBodies; ++i) {
            const DVec2 place = {-4 + 1.6 * (i % 6), -4 + 1.6 * (i / 6)};
            const Vec2 velocity = vec(random.range(-3, 3), random.range(-3, 3));
            const Polygon shape = box(random.range(0.2, 0.6), 0.4);
            bodies.push_back(addBody(world, dynamicAt(place, velocity, 2), shape, material(0.5)));
            must(world.addShape(bodies.back(), circle(0.1), material(0.3)));
            if (i % 3 == 1) { must(world.createJoint(hingeTo(bodies[bodies.size() - 2], place - DVec2{0.8, 0}))); }
        }
        runFor(world, 2);
    }
    RevoluteJointDef hingeTo(BodyId other, DVec2 anchor) const {
        RevoluteJointDef def;
        def.base = {.bodyA = other, .bodyB = bodies.back()};
        def.anchor = anchor;
        return def;
    }
    std::size_t pointCount() const {
        std::size_t count = 0;
        world.visitContacts([&count](const ContactView&) { ++count; });
        return count;
    }
};

const WorldTransform kMiddle{};

TEST(ChangingVisits, MayDestroyWhatTheyAreToldOf) {
    Heap heap(1);
    World& world = heap.world;
    std::set<std::uint32_t> gone;
    const auto destroyLoose = [&](ShapeId shape) {
        const BodyId body = world.bodyOf(shape);
        EXPECT_TRUE(world.isValid(body)) << "told of what is gone";
        if (world.type(body) == BodyType::dynamic) {
            gone.insert(body.index);
            must(world.destroyBody(body));
        }
        return true;
    };
    world.overlapShape(box(5, 1), {{0, -4}, {}}, {}, destroyLoose);
    EXPECT_GT(gone.size(), 2u);
    world.overlapShape(box(5, 1), {{0, -4}, {}}, {}, [&](ShapeId shape) {
        EXPECT_EQ(world.bodyOf(shape), heap.walls);
        return true;
    });
    world.queryBox({vec(-6, -6), vec(6, 6)}, {}, destroyLoose);
    EXPECT_EQ(gone.size(), heap.bodies.size());
    EXPECT_EQ(world.bodyCount(), 1u);
    EXPECT_EQ(world.jointCount(), 0u);
    run(world, 10);
}

TEST(ChangingVisits, MayPushAndWakeWhatTheyAreToldOf) {
    Heap heap(2);
    World& world = heap.world;
    for (const BodyId body : heap.bodies) { must(world.setAwake(body, false)); }
    std::set<std::uint32_t> pushed;
    world.overlapShape(box(6, 6), kMiddle, {}, [&](ShapeId shape) {
        const BodyId body = world.bodyOf(shape);
        if (world.type(body) == BodyType::dynamic && pushed.insert(body.index).second) {
            must(world.applyImpulse(body, vec(0, 5 * world.mass(body))));
        }
        return true;
    });
    EXPECT_EQ(pushed.size(), heap.bodies.size());
    for (const BodyId body : heap.bodies) { EXPECT_NEAR(world.velocity(body).y, 5, 1e-5) << body.index; }
}

TEST(ChangingVisits, OfShapesAndJointsMayEndThem) {
    Heap heap(3);
    World& world = heap.world;
    for (const BodyId body : heap.bodies) {
        int shapes = 0;
        world.visitShapes(body, [&](ShapeId shape) {
            ++shapes;
            must(world.destroyShape(shape));
        });
        EXPECT_EQ(shapes, 2);
        int left = 0;
        world.visitShapes(body, [&left](ShapeId) { ++left; });
        EXPECT_EQ(left, 0);
        world.visitJoints(body, [&](JointId joint) { must(world.destroyJoint(joint)); });
    }
    EXPECT_EQ(world.jointCount(), 0u);
    int segments = 0;
    world.visitPolygons(heap.chain, [&](const Polygon& polygon) {
        if (++segments == 2) { must(world.destroyShape(heap.chain)); }
        EXPECT_EQ(polygon.count, 2);
    });
    EXPECT_EQ(segments, 2);
}

TEST(ChangingVisits, GoOnlyThroughWhatThereWas) {
    Heap heap(4);
    World& world = heap.world;
    const std::uint32_t before = world.bodyCount();
    std::uint32_t told = 0;
    world.visitBodies([&](BodyId) {
        ++told;
        addBody(world, dynamicAt({0, 20.0 + told}), circle(0.2));
    });
    EXPECT_EQ(told, before);
    EXPECT_EQ(world.bodyCount(), 2 * before);
    told = 0;
    world.queryBox({vec(-50, -50), vec(50, 500)}, {}, [&](ShapeId) {
        addBody(world, dynamicAt({20, 20.0 + ++told}), circle(0.2));
        return true;
    });
    EXPECT_EQ(world.bodyCount(), 2 * before + told);
    world.visitBodies([&](BodyId body) { must(world.destroyBody(body)); });
    EXPECT_EQ(world.bodyCount(), 0u);
}

TEST(ChangingVisits, OfContactsAreNotToldOfWhatIsGone) {
    Heap heap(5);
    World& world = heap.world;
    ASSERT_GT(heap.pointCount(), 20u);
    std::size_t told = 0;
    const auto destroyBoth = [&](const ContactView& view) {
        ++told;
        for (const BodyId body : {view.bodyA, view.bodyB}) {
            EXPECT_TRUE(world.isValid(body));
            if (body != heap.walls) { must(world.destroyBody(body)); }
        }
    };
    world.visitContacts(heap.bodies[0], destroyBoth);
    world.visitOverlaps(heap.sensor, [&](ShapeId shape) {
        EXPECT_TRUE(world.isValid(shape));
        if (told < 10) { must(world.destroyBody(world.bodyOf(shape))); }
        ++told;
    });
    world.visitContacts(destroyBoth);
    EXPECT_GT(told, 10u);
    EXPECT_EQ(heap.pointCount(), 0u);
}

TEST(ChangingVisits, OfCastsComeInOrder) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Heap heap(seed);
        World& world = heap.world;
        Random random(seed);
        const DVec2 from = {-20, random.range(-4, 0)};
        const Vec2 way = vec(40, random.range(-2, 2));
        const QueryFilter all;
        std::vector<CastHit> hits;
        const auto list = [&](const CastHit& hit) {
            hits.push_back(hit);
            return Real(1);
        };
        world.castRayAll(from, way, all, list);
        ASSERT_GE(hits.size(), 2u);
        for (std::size_t i = 1; i < hits.size(); ++i) { EXPECT_LE(hits[i - 1].fraction, hits[i].fraction); }
        EXPECT_EQ(hits[0].shape, world.castRay(from, way).shape);
        const std::size_t onRay = hits.size();
        hits.clear();
        world.castShapeAll(circle(0.2), {from, {}}, way, all, list);
        EXPECT_GE(hits.size(), onRay) << "a thicker ray";
        for (std::size_t i = 1; i < hits.size(); ++i) { EXPECT_LE(hits[i - 1].fraction, hits[i].fraction); }
        EXPECT_EQ(hits[0].shape, world.castShape(circle(0.2), {from, {}}, way).shape);

        int told = 0;
        world.castRayAll(from, way, all, [&](const CastHit& hit) {
            EXPECT_TRUE(world.isValid(hit.shape));
            ++told;
            world.visitBodies([&](BodyId body) { must(world.destroyBody(body)); });
            return Real(1);
        });
        EXPECT_EQ(told, 1);
    }
}

/// Whatever is called back changes, and however the visit goes on: nothing crashes, and nothing is told that is gone.
class Meddler {
public:
    Meddler(Heap& heap, Random& random) : heap_(heap), random_(random), start_(heap.world) {}

    void expectThere(ShapeId shape) { EXPECT_TRUE(heap_.world.isValid(shape)); }
    void meddle() {
        World& world = heap_.world;
        const BodyId body = heap_.bodies[static_cast<std::size_t>(random_.integer(0, kBodies - 1))];
        switch (random_.integer(0, 11)) {
            case 0:
                (void)world.destroyBody(body);
                break;
            case 1:
                world.visitShapes(body, [&](ShapeId shape) { (void)world.destroyShape(shape); });
                break;
            case 2:
                world.visitJoints(body, [&](JointId joint) { (void)world.destroyJoint(joint); });
                break;
            case 3:
                (void)world.setPose(body, {random_.range(-5, 5), random_.range(-5, 5)}, random_.range(-3, 3));
                break;
            case 4:
                (void)world.applyImpulse(body, vec(random_.range(-1, 1), random_.range(-1, 1)));
                break;
            case 5:
                (void)world.setEnabled(body, random_.chance(0.5));
                break;
            case 6:
                (void)world.setAwake(body, random_.chance(0.5));
                break;
            case 7:
                (void)world.redefine(body, {.type = BodyType::kinematic});
                break;
            case 8:
                (void)world.step(kStep);
                break;
            case 9:
                for (int i = 0; i < 40; ++i) { addBody(world, dynamicAt({0, 0}), circle(0.3), material(0.5)); }
                break;
            case 10:
                (void)world.addShape(body, circle(0.2));
                break;
            default:
                world = start_;  // back to a snapshot
        }
    }

private:
    Heap& heap_;
    Random& random_;
    World start_;
};

TEST(ChangingVisits, MayDoWhatever) {
    using Ask = std::function<void(World&, const std::function<void(ShapeId)>&)>;
    for (std::uint64_t seed = 1; seed <= someOf(60U); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Heap heap(seed % 5);
        Meddler meddler(heap, random);
        const BodyId one = heap.bodies[seed % kBodies];
        const ShapeId none{};
        const std::vector<Ask> asks{
            [](World& w, const auto& f) {
                w.queryBox({vec(-6, -6), vec(6, 6)}, {}, [&](ShapeId s) { return f(s), true; });
            },
            [](World& w, const auto& f) {
                w.overlapShape(circle(4), kMiddle, {}, [&](ShapeId s) { return f(s), true; });
            },
            [](World& w, const auto& f) {
                w.castRayAll({-7, -5}, vec(14, 1), {}, [&](const CastHit& hit) { return f(hit.shape), Real(1); });
            },
            [](World& w, const auto& f) {
                w.castShapeAll(circle(0.5), {{-7, -5}, {}}, vec(14, 1), {},
                               [&](const CastHit& hit) { return f(hit.shape), Real(1); });
            },
            [](World& w, const auto& f) {
                w.visitContacts([&](const ContactView& view) { f(view.shapeA), w.isValid(view.shapeB); });
            },
            [&](World& w, const auto& f) { w.visitContacts(one, [&](const ContactView& view) { f(view.shapeB); }); },
            [&](World& w, const auto& f) { w.visitOverlaps(heap.sensor, f); },
            [&](World& w, const auto& f) { w.visitShapes(one, f); },
            [&](World& w, const auto& f) { w.visitPolygons(heap.chain, [&](const Polygon&) { f(heap.chain); }); },
            [&](World& w, const auto& f) {
                w.visitBodies([&](BodyId body) { EXPECT_TRUE(w.isValid(body)), f(none); });
            },
            [&](World& w, const auto& f) { w.visitMoved([&](BodyId body) { EXPECT_TRUE(w.isValid(body)), f(none); }); },
            [&](World& w, const auto& f) { w.visitJoints([&](JointId id) { EXPECT_TRUE(w.isValid(id)), f(none); }); },
            [&](World& w, const auto& f) {
                w.visitJoints(one, [&](JointId id) { EXPECT_TRUE(w.isValid(id)), f(none); });
            },
        };
        for (const Ask& ask : asks) {
            ask(heap.world, [&](ShapeId shape) {
                if (shape != none) { meddler.expectThere(shape); }
                meddler.meddle();
            });
            (void)heap.world.step(kStep);
        }
    }
}

}  // namespace
}  // namespace swept::test
