#include "box2d3_crowd.h"

#include <box2d/box2d.h>

#include "box2d3_vector.h"

namespace swept::bench {
namespace {

constexpr int kSubSteps = 4;

class Box2d3Crowd final : public CrowdEngine {
public:
    Box2d3Crowd() = default;
    Box2d3Crowd(const Box2d3Crowd&) = delete;
    Box2d3Crowd& operator=(const Box2d3Crowd&) = delete;
    ~Box2d3Crowd() override { end(); }

    std::string name() const override { return "Box2D 3"; }

    void begin(const Crowd& crowd) override {
        end();
        b2WorldDef worldDef = b2DefaultWorldDef();
        worldDef.gravity = {0, 0};
        worldDef.enableSleep = false;
        world_ = b2CreateWorld(&worldDef);
        alive_ = true;
        b2ShapeDef shape = b2DefaultShapeDef();
        shape.density = static_cast<float>(kCrowdDensity);
        shape.material.friction = static_cast<float>(kCrowdFriction);
        shape.material.restitution = static_cast<float>(crowd.restitution);
        const b2BodyDef fixedDef = b2DefaultBodyDef();
        for (const CrowdWall& wall : crowd.walls) {
            const b2Segment segment{vectorOf(wall.p), vectorOf(wall.q)};
            b2CreateSegmentShape(b2CreateBody(world_, &fixedDef), &shape, &segment);
        }
        const b2Circle disk{{0, 0}, static_cast<float>(kCrowdRadius)};
        const b2Polygon square = b2MakeSquare(static_cast<float>(kCrowdRadius));
        shape.filter.groupIndex = crowd.bodiesMeet ? 0 : -1;
        for (const CrowdBody& body : crowd.bodies) {
            b2BodyDef def = b2DefaultBodyDef();
            def.type = b2_dynamicBody;
            def.position = vectorOf(body.place);
            def.rotation = b2MakeRot(static_cast<float>(body.angle));
            def.linearVelocity = vectorOf(body.velocity);
            def.angularVelocity = static_cast<float>(body.spin);
            bodies_.push_back(b2CreateBody(world_, &def));
            if (body.isDisk) {
                b2CreateCircleShape(bodies_.back(), &shape, &disk);
            } else {
                b2CreatePolygonShape(bodies_.back(), &shape, &square);
            }
        }
    }

    void step() override { b2World_Step(world_, 1.0F / 60, kSubSteps); }

    std::vector<CrowdBody> bodies() const override {
        std::vector<CrowdBody> result;
        for (const b2BodyId body : bodies_) {
            const auto place = b2Body_GetPosition(body);
            const b2Vec2 velocity = b2Body_GetLinearVelocity(body);
            result.push_back({.place = {static_cast<double>(place.x), static_cast<double>(place.y)},
                              .velocity = {static_cast<double>(velocity.x), static_cast<double>(velocity.y)},
                              .spin = static_cast<double>(b2Body_GetAngularVelocity(body))});
        }
        return result;
    }

private:
    void end() {
        if (alive_) { b2DestroyWorld(world_); }
        alive_ = false;
        bodies_.clear();
    }

    b2WorldId world_{};
    bool alive_ = false;
    std::vector<b2BodyId> bodies_;
};

}  // namespace

std::unique_ptr<CrowdEngine> makeBox2d3Crowd() { return std::make_unique<Box2d3Crowd>(); }

}  // namespace swept::bench
