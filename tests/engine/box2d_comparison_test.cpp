#include <box2d/box2d.h>

#include "world_support.h"

/// The same little scenes in Box2D 2.4.1, as a witness that is not us.

namespace swept::test {
namespace {

/// Way that a box slides on level ground until it rests, m.
double slidInBox2d(double speed, double friction) {
    b2World world(b2Vec2(0, static_cast<float>(-kGravity)));
    b2BodyDef groundDef;
    groundDef.position.Set(0, -1);
    b2PolygonShape shape;
    shape.SetAsBox(100, 1);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(friction);
    world.CreateBody(&groundDef)->CreateFixture(&fixture);
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

}  // namespace
}  // namespace swept::test
