#include <box2d/box2d.h>

#include "crowd.h"

namespace swept::bench {
namespace {

constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 crowdVector(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

/// Box2D 2.4.1 with its own advice for iterations; continuous collision and sub-stepping of bodies as they come.
class Box2dCrowd final : public CrowdEngine {
public:
    std::string name() const override { return "Box2D 2.4.1"; }

    void begin(const Crowd& crowd) override {
        bodies_.clear();
        world_ = std::make_unique<b2World>(b2Vec2{0, 0});
        world_->SetAllowSleeping(false);
        b2FixtureDef fixture;
        fixture.density = static_cast<float>(kCrowdDensity);
        fixture.friction = static_cast<float>(kCrowdFriction);
        fixture.restitution = static_cast<float>(crowd.restitution);
        const b2BodyDef fixedDef;
        for (const CrowdWall& wall : crowd.walls) {
            b2EdgeShape edge;
            edge.SetTwoSided(crowdVector(wall.p), crowdVector(wall.q));
            fixture.shape = &edge;
            world_->CreateBody(&fixedDef)->CreateFixture(&fixture);
        }
        b2CircleShape disk;
        disk.m_radius = static_cast<float>(kCrowdRadius);
        b2PolygonShape square;
        square.SetAsBox(static_cast<float>(kCrowdRadius), static_cast<float>(kCrowdRadius));
        fixture.filter.groupIndex = crowd.bodiesMeet ? 0 : -1;
        for (const CrowdBody& body : crowd.bodies) {
            b2BodyDef def;
            def.type = b2_dynamicBody;
            def.position = crowdVector(body.place);
            def.angle = static_cast<float>(body.angle);
            def.linearVelocity = crowdVector(body.velocity);
            def.angularVelocity = static_cast<float>(body.spin);
            fixture.shape = body.isDisk ? static_cast<const b2Shape*>(&disk) : &square;
            bodies_.push_back(world_->CreateBody(&def));
            bodies_.back()->CreateFixture(&fixture);
        }
    }

    void step() override { world_->Step(1.0F / 60, kVelocityIterations, kPositionIterations); }

    std::vector<CrowdBody> bodies() const override {
        std::vector<CrowdBody> result;
        for (const b2Body* body : bodies_) {
            const b2Vec2 place = body->GetPosition();
            const b2Vec2 velocity = body->GetLinearVelocity();
            result.push_back({.place = {static_cast<double>(place.x), static_cast<double>(place.y)},
                              .angle = static_cast<double>(body->GetAngle()),
                              .velocity = {static_cast<double>(velocity.x), static_cast<double>(velocity.y)},
                              .spin = static_cast<double>(body->GetAngularVelocity())});
        }
        return result;
    }

private:
    std::unique_ptr<b2World> world_;
    std::vector<b2Body*> bodies_;
};

}  // namespace

std::unique_ptr<CrowdEngine> makeBox2dCrowd() { return std::make_unique<Box2dCrowd>(); }

}  // namespace swept::bench
