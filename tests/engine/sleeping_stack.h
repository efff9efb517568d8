#pragma once

#include <algorithm>
#include <vector>

#include "world_support.h"

namespace swept::test {

/// Five boxes, one on another.
struct SleepingStack {
    World world;
    BodyId ground;
    std::vector<BodyId> boxes;

    explicit SleepingStack(bool sleep = true) {
        WorldSettings settings = awakeSettings();
        settings.sleep = sleep;
        world = makeWorld(settings);
        ground = addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
        for (int i = 0; i < 5; ++i) {
            boxes.push_back(addBody(world, dynamicAt({0, i + 0.5}), box(0.5, 0.5), material(0.6)));
        }
    }
    int awake() const {
        return static_cast<int>(
            std::count_if(boxes.begin(), boxes.end(), [&](BodyId body) { return world.isAwake(body); }));
    }
};

}  // namespace swept::test
