#include <box2d/box2d.h>

#include "world_support.h"

/// The same little scenes in Box2D 2.4.1, as a witness that is not us.

namespace swept::test {
namespace {

b2Vec2 toBox2d(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

/// Ground through the origin that rises by the angle.
void addGround(b2World& world, double angle, double friction) {
    b2BodyDef def;
    def.position = toBox2d(turned({0, -1}, angle));
    def.angle = static_cast<float>(angle);
    b2PolygonShape shape;
    shape.SetAsBox(100, 1);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(friction);
    world.CreateBody(&def)->CreateFixture(&fixture);
}

/// Way that a box slides on level ground until it rests, m.
double slidInBox2d(double speed, double friction) {
    b2World world(b2Vec2(0, static_cast<float>(-kGravity)));
    addGround(world, 0, friction);
    b2FixtureDef fixture;
    fixture.friction = static_cast<float>(friction);
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position.Set(0, 0.5F);
    def.linearVelocity.Set(static_cast<float>(speed), 0);
    b2PolygonShape unit;
    unit.SetAsBox(0.5F, 0.5F);
    fixture.shape = &unit;
    fixture.density = 1;
    b2Body* body = world.CreateBody(&def);
    body->CreateFixture(&fixture);
    for (int i = 0; i < 300; ++i) { world.Step(static_cast<float>(kStep), 8, 3); }
    return static_cast<double>(body->GetPosition().x);
}

double slidInSwept(double speed, double friction) {
    World world = makeWorld();
    addStatic(world, box(100, 1), material(friction), {0, -1});
    const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(speed, 0)), box(0.5, 0.5), material(friction));
    run(world, 300);
    return world.position(body).x;
}

TEST(Box2dComparison, BoxSlidesAsFar) {
    for (const double speed : {3.0, 6.0, 9.0}) {
        for (const double friction : {0.2, 0.6}) {
            const double theirs = slidInBox2d(speed, friction);
            const double ours = slidInSwept(speed, friction);
            const double exact = speed * speed / (2 * friction * kGravity);
            const std::string name = std::to_string(speed) + " m/s, mu " + std::to_string(friction);
            expectAtMost(name, std::abs(ours - theirs) / exact, 0.06);  // Box2D loses half a step of way
            EXPECT_LE(std::abs(ours - exact), std::abs(theirs - exact))
                << name << ": Box2D is nearer to the closed form";
        }
    }
}

/// Box2D asks for the speed of each contact anew before it is solved.
class Belt : public b2ContactListener {
public:
    explicit Belt(double speed) : speed_(speed) {}
    void PreSolve(b2Contact* contact, const b2Manifold*) override {
        contact->SetTangentSpeed(static_cast<float>(speed_));
    }

private:
    double speed_;
};

/// How far a disk and a box are after 2 s on a belt that runs up a slope of 0.2, m along the slope.
struct Carried {
    double box = 0;
    double disk = 0;
    double fastest = 0;  ///< of both, m/s
};
constexpr double kSlope = 0.2;

Carried carriedInBox2d(double speed, double friction) {
    Belt belt(speed);
    b2World world(b2Vec2(0, static_cast<float>(-kGravity)));
    world.SetContactListener(&belt);
    addGround(world, kSlope, friction);
    b2FixtureDef fixture;
    fixture.friction = static_cast<float>(friction);
    b2PolygonShape square;
    square.SetAsBox(0.5F, 0.5F);
    b2CircleShape circle;
    circle.m_radius = 0.5F;
    fixture.density = 1;
    const auto drop = [&](double x, const b2Shape& shape) {
        b2BodyDef def;
        def.type = b2_dynamicBody;
        def.position = toBox2d(turned({x, 0.5}, kSlope));
        def.angle = static_cast<float>(kSlope);
        def.allowSleep = false;
        b2Body* const body = world.CreateBody(&def);
        fixture.shape = &shape;
        body->CreateFixture(&fixture);
        return body;
    };
    const b2Body* const box = drop(0, square);
    const b2Body* const disk = drop(50, circle);
    for (int i = 0; i < 120; ++i) { world.Step(static_cast<float>(kStep), 8, 3); }
    const auto way = [](const b2Body* body) {
        const DVec2 place{static_cast<double>(body->GetPosition().x), static_cast<double>(body->GetPosition().y)};
        return dot(place, turned({1, 0}, kSlope));
    };
    return {way(box), way(disk) - 50, 0};
}

Carried carriedInSwept(double speed, double friction) {
    World world = makeWorld();
    ShapeDef belt = material(friction);
    belt.surfaceSpeed = real(speed);
    addStatic(world, box(100, 1), belt, turned({0, -1}, kSlope), kSlope);
    const auto drop = [&](double x, const Polygon& polygon) {
        BodyDef def = dynamicAt(turned({x, 0.5}, kSlope));
        def.angle = kSlope;
        return addBody(world, def, polygon, material(friction));
    };
    const BodyId square = drop(0, box(0.5, 0.5));
    const BodyId disk = drop(50, circle(0.5));
    double fastest = 0;
    for (int i = 0; i < 120; ++i) {
        run(world, 1);
        for (const BodyId body : {square, disk}) { fastest = std::max(fastest, length(velocityOf(world, body))); }
    }
    const auto way = [&world](BodyId body) { return dot(world.position(body), turned({1, 0}, kSlope)); };
    return {way(square), way(disk) - 50, fastest};
}

/// A box is carried up, or slips; a disk rolls down, or is held up by a fast one for a while.
TEST(Box2dComparison, BeltsCarryAsFar) {
    for (const double speed : {-3.0, 1.0, 4.0, 20.0}) {
        for (const double friction : {0.1, 0.5}) {
            const Carried theirs = carriedInBox2d(speed, friction);
            const Carried ours = carriedInSwept(speed, friction);
            const std::string name = std::to_string(speed) + " m/s, mu " + std::to_string(friction);
            const double limit = 0.01 + ours.fastest * kStep / 2;  // that half a step of way again, and its skin
            expectAtMost(name + ", box", std::abs(ours.box - theirs.box), limit);
            expectAtMost(name + ", disk", std::abs(ours.disk - theirs.disk), limit);
        }
    }
}

}  // namespace
}  // namespace swept::test
