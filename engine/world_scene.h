#pragma once

#include <functional>
#include <string>

#include "../shapes/real.h"
#include "ids.h"

namespace swept::inline SWEPT_PRECISION {

class World;

/// What a scene and its things are called. What has no name, or an empty one, goes by its place: `body0`, `joint0`, …
/// Of bodies, or joints, that are called alike the later ones get a number behind it ("crate 2"); what is not UTF-8
/// becomes question marks.
struct SceneNames {
    std::string scene{};
    std::function<std::string(BodyId)> ofBody{};
    std::function<std::string(JointId)> ofJoint{};
};

/// The world as it is now, as a scene: JSON text in the format of samples/README.md, for the `swept` command, which
/// draws it, looks for what may go wrong in it, and compares it with Box2D. Bodies, and joints, are in the order of
/// their slots; joints begin where they are: with their gaps, angles and translations, the slack of their ropes and
/// what loads their springs. The text is locale-free, in the shortest decimal digits that give the same number again,
/// and the same on every machine.
///
/// A scene begins where the world is, not with its bits: it has no contacts yet, nothing is held in balance. It does
/// not have what the format has no word for: forces for the next step, contact filters and user data; how far gears are
/// from holding (in the scene they hold), and where motor joints count `jointTranslation` from; the second damping
/// ratio of a weld with two springs, and what a spring's length is beyond its limits. Left out are joints that hold
/// nothing because neither body is dynamic, and gears on those; a motor joint without strength becomes a filter. A
/// dynamic body without mass has a milligram, one without inertia does not turn, and numbers end at 3e38, as those of
/// scenes do. Takes about a microsecond for each number: for a report, not for every frame.
std::string sceneOf(const World& world, const SceneNames& names = {});

}  // namespace swept::inline SWEPT_PRECISION
