#include "builtin_scenes.h"

#include <array>

namespace swept {
namespace {

constexpr std::array<BuiltinScene, 22> kScenes{{
    {"falling-shapes", "boxes, balls, capsules and polygons fall into a tray and come to rest", scenes::fallingShapes,
     8},
    {"pyramid", "210 boxes stand still on each other, then a heavy ball arrives", scenes::pyramid, 10},
    {"tall-stack", "20 boxes stand; so do a ladder of planks and boxes that get heavier upwards", scenes::tallStack,
     10},
    {"bouncing-balls", "restitution from 0 on the left to 1 on the right, for balls and for tilted boxes",
     scenes::bouncingBalls, 10},
    {"friction-ramp", "five boxes on a slope of 3 in 4: those with too little friction slide", scenes::frictionRamp, 6},
    {"dominoes", "two rows fall towards opposite sides, each hit by a rolling ball", scenes::dominoes, 8},
    {"newtons-cradle", "momentum runs through five balls on rods; a double pendulum beside them", scenes::newtonsCradle,
     12},
    {"ragdolls", "jointed figures with limited joints tumble down stairs", scenes::ragdolls, 8},
    {"hanging-chain", "a chain swings a heavy ball; a plank bridge carries boxes", scenes::hangingChain, 12},
    {"machine-room", "gears and a rack, a pulley, a lift, a springboard: all joints but wheels at work",
     scenes::machineRoom, 8},
    {"conveyors", "belts carry what falls from a hopper to and fro; a crawler climbs steps on its own track",
     scenes::conveyors, 12},
    {"car", "a car with sprung wheels drives over bumps and jumps a gap", scenes::car, 7},
    {"terrain", "balls, capsules and boxes roll over one chain without catching on its vertices", scenes::terrain, 12},
    {"paddle-drum", "a kinematic paddle stirs a drum; a sensor watches who passes", scenes::paddleDrum, 12},
    {"bullet-curtain", "bullets of 25 to 1600 m/s against walls of 1 cm and of no thickness at all",
     scenes::bulletCurtain, 3},
    {"continuous-off", "mode off: four fast shots at a thin wall pass through it", scenes::continuousOff, 1},
    {"continuous-speed-limit", "mode speedLimit: the same shots, slowed to what the wall can hold",
     scenes::continuousSpeedLimit, 1},
    {"continuous-speculative", "mode speculative: the shots that the wall holds, and one stopped by nothing",
     scenes::continuousSpeculative, 1},
    {"continuous-stop", "mode stop: held at the wall, and the rest of the step lost", scenes::continuousStop, 1},
    {"continuous-sub-step", "mode subStep: off the wall within the step, and nothing lost", scenes::continuousSubStep,
     1},
    {"spinning-bars", "thin bars spin at up to 60 rad/s into a field of pins, and each other: they are bullets",
     scenes::spinningBars, 8},
    {"slender-and-tiny", "a table of 90 cm: rods 2 mm thin, shot of 4 mm, a shelf without thickness",
     scenes::slenderAndTiny, 4},
}};

}  // namespace

std::span<const BuiltinScene> builtinScenes() { return kScenes; }

const BuiltinScene* findBuiltinScene(std::string_view name) {
    for (const BuiltinScene& scene : kScenes) {
        if (name == scene.name) { return &scene; }
    }
    return nullptr;
}

}  // namespace swept
