#pragma once

#include <memory>
#include <vector>

#include <swept/samples/scene_description.h>

#include "box2d_sample.h"

namespace swept {

/// A scene in Box2D 2.4.1. Lives in the child process only: Box2D asserts, and so ends the process, on some input.
class Box2dWorld {
public:
    /// @param scene  accepted by `validateScene`; outlives the world.
    Box2dWorld(const SceneDescription& scene, const Box2dIterations& iterations);
    ~Box2dWorld();
    Box2dWorld(const Box2dWorld&) = delete;
    Box2dWorld& operator=(const Box2dWorld&) = delete;

    /// One step of the scene's dt.
    void step();
    Box2dSample sample() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace swept
