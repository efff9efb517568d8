#pragma once

#include <span>
#include <string_view>

#include "../scene_description.h"

namespace swept {

/// A scene that ships with the program: `swept run NAME`.
struct BuiltinScene {
    const char* name;     ///< lower case and hyphens
    const char* purpose;  ///< one line: what there is to see
    SceneDescription (*make)();
    double duration;  ///< seconds that show it all: how long it runs unless told otherwise
};

/// All of them, in the order in which a new user should meet them.
std::span<const BuiltinScene> builtinScenes();

/// Null when there is none of that name.
const BuiltinScene* findBuiltinScene(std::string_view name);

/// The makers, one file per theme; the table is in builtin_scenes.cpp.
namespace scenes {
SceneDescription fallingShapes();
SceneDescription pyramid();
SceneDescription tallStack();
SceneDescription bouncingBalls();
SceneDescription frictionRamp();
SceneDescription dominoes();
SceneDescription newtonsCradle();
SceneDescription ragdolls();
SceneDescription hangingChain();
SceneDescription machineRoom();
SceneDescription conveyors();
SceneDescription car();
SceneDescription terrain();
SceneDescription paddleDrum();
SceneDescription bulletCurtain();
SceneDescription continuousOff();
SceneDescription continuousSpeedLimit();
SceneDescription continuousSpeculative();
SceneDescription continuousStop();
SceneDescription continuousSubStep();
SceneDescription spinningBars();
SceneDescription slenderAndTiny();
}  // namespace scenes

}  // namespace swept
