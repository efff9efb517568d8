#pragma once

#include <cstdint>
#include <string>

#include <swept/samples/scene_builder.h>

namespace swept::scenes {

/// A heap of 252 bodies that fly at a floor beside each other, nearly as fast as each other: which of them are hemmed
/// in when the first ones strike (engine/contacts/hemmed_pairs.h) is asked of hundreds of pairs. Its numbers are the
/// same on every machine.
/// @param seed  of gap, speed, disorder, and what the heap is made of: the more kinds of shapes, the larger it is
inline SceneDescription fallingHeap(int seed) {
    using namespace build;
    constexpr int kColumns = 14;
    constexpr int kRows = 18;
    SceneDescription scene = build::scene("falling heap " + std::to_string(seed), {0, 8}, 24);
    addFixed(scene, "floor", {0, -1}, {box({40, 1})});
    Dice dice(static_cast<std::uint64_t>(seed));
    const double pitch = 1 + dice.range(0, 0.12);
    const double speed = dice.range(10, 60);
    const double disorder = dice.range(0, 3);
    for (int i = 0; i < kColumns * kRows; ++i) {
        const DVec2 place{pitch * (i % kColumns) - 7, 2 + pitch * (i / kColumns)};
        BodyDescription& body = addDynamic(scene, "", place, {box({0.5, 0.5})});
        switch (i % (1 + seed % 4)) {
            case 1:
                body.shapes = {capsule({-0.3, 0}, {0.3, 0}, 0.2)};
                break;
            case 2:
                body.shapes = {box({0.5, 0.2}, {0, -0.3}), box({0.2, 0.5}, {-0.3, 0})};
                break;
            case 3:
                body.shapes = {circle(0.5)};
                break;
            default:
                break;
        }
        body.angle = 0.04 * dice.range(-disorder, disorder);
        body.velocity = {dice.range(-disorder, disorder), dice.range(-disorder, disorder) - speed};
        body.angularVelocity = dice.range(-disorder, disorder);
    }
    return scene;
}

}  // namespace swept::scenes
