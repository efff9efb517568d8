#pragma once

#include <cstdint>
#include <vector>

#include <swept/engine/body_def.h>
#include <swept/engine/joint_def.h>
#include <swept/engine/shape_def.h>
#include <swept/shapes/polygon.h>

namespace swept::bench {

struct PeerShape {
    Polygon polygon;
    ShapeDef def{};
};

struct PeerBody {
    BodyDef def{};
    std::vector<PeerShape> shapes;
    std::vector<Vec2> loop;  ///< of a chain, counter-clockwise or clockwise as it is solid; empty: none
    Real loopFriction = 0;
};

/// A hinge between two bodies by their numbers.
struct PeerHinge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    DVec2 anchor{};
    std::optional<AngleLimits> limits{};
    std::optional<AngularMotor> motor{};
    std::optional<Spring> spring{};
};

/// A world that can play the scenes: ours, or another engine's. Bodies are numbered as they come; no number is used twice.
class PeerWorld {
public:
    virtual ~PeerWorld() = default;

    virtual void setGravity(Vec2 gravity) = 0;
    virtual void setSleep(bool allowed) = 0;
    virtual std::uint32_t addBody(const PeerBody& body) = 0;
    /// With its hinges.
    virtual void removeBody(std::uint32_t body) = 0;
    virtual void addHinge(const PeerHinge& hinge) = 0;
    virtual void setVelocity(std::uint32_t body, Vec2 velocity) = 0;
    virtual void step(double dt) = 0;
};

}  // namespace swept::bench
