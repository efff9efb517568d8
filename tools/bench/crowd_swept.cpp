#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>

#include "crowd.h"

namespace swept::bench {
namespace {

ShapeDescription surfaceOf(ShapeDescription shape, const Crowd& crowd) {
    shape.friction = kCrowdFriction;
    shape.restitution = crowd.restitution;
    shape.density = kCrowdDensity;
    return shape;
}

class SweptCrowd final : public CrowdEngine {
public:
    explicit SweptCrowd(CrowdSweeps sweeps) : sweeps_(sweeps) {}

    std::string name() const override {
        switch (sweeps_) {
            case CrowdSweeps::nothing:
                return "Swept2D, mode off";
            case CrowdSweeps::walls:
                return "Swept2D";
            case CrowdSweeps::everything:
                return "Swept2D, all bullets";
        }
        return "";
    }

    void begin(const Crowd& crowd) override {
        SceneDescription scene = build::scene(crowd.name, {0, 0}, 10);
        scene.gravity = {0, 0};
        scene.settings.sleep = false;
        scene.settings.dt = 1.0 / 60;
        scene.settings.continuous = sweeps_ != CrowdSweeps::nothing ? SceneContinuous::subStep : SceneContinuous::off;
        for (const CrowdWall& wall : crowd.walls) {
            build::addFixed(scene, "", {0, 0}, {surfaceOf(build::segment(wall.p, wall.q), crowd)});
        }
        walls_ = crowd.walls.size();
        for (const CrowdBody& body : crowd.bodies) {
            ShapeDescription shape =
                surfaceOf(body.isDisk ? build::circle(kCrowdRadius) : build::box({kCrowdRadius, kCrowdRadius}), crowd);
            if (!crowd.bodiesMeet) { shape.filter.group = -1; }
            BodyDescription& added = build::addDynamic(scene, "", body.place, {std::move(shape)});
            added.angle = body.angle;
            added.velocity = body.velocity;
            added.angularVelocity = body.spin;
            added.bullet = sweeps_ == CrowdSweeps::everything;
        }
        std::string error;
        runner_ = makeRunner(scene, {}, error);
    }

    void step() override { runner_->step(); }

    std::vector<CrowdBody> bodies() const override {
        Frame frame;
        runner_->read(frame, false);
        std::vector<CrowdBody> result;
        for (std::size_t i = walls_; i < frame.bodies.size(); ++i) {
            const BodyFrame& body = frame.bodies[i];
            result.push_back(
                {.place = body.position, .angle = body.angle, .velocity = body.velocity, .spin = body.angularVelocity});
        }
        return result;
    }

    double lostSeconds() const override {
        double seconds = 0;
        for (const LostTime& entry : runner_->report().lostTime) { seconds += entry.seconds; }
        return seconds;
    }

private:
    CrowdSweeps sweeps_;
    std::unique_ptr<Runner> runner_;
    std::size_t walls_ = 0;
};

}  // namespace

std::unique_ptr<CrowdEngine> makeSweptCrowd(CrowdSweeps sweeps) { return std::make_unique<SweptCrowd>(sweeps); }

}  // namespace swept::bench
