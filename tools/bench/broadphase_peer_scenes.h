#pragma once

#include <cstdint>

#include "broadphase_trace.h"

namespace swept::bench {

/// The eight benchmark scenes of Box2D 3.3 in which pair finding takes a quarter of its step or more
/// (worlds/bench_scene.h).
enum class PeerScene : std::uint8_t { compounds, smash, spinner, tumbler, washer, jointGrid, rain, junkyard };
inline constexpr PeerScene kPeerScenes[] = {
    PeerScene::compounds, PeerScene::smash,     PeerScene::spinner, PeerScene::tumbler,
    PeerScene::washer,    PeerScene::jointGrid, PeerScene::rain,    PeerScene::junkyard,
};

const char* nameOf(PeerScene scene);

struct RecordedScene {
    Motion motion;
    std::size_t warmSteps = 1;  ///< until the scene is in the state that is to be timed
};

/// Bounds of all shapes as our world (f32, profile `fast`, 60 Hz, no sleep) moves them.
/// @param stepScale  of the number of steps, 0 … 1, for quick looks
RecordedScene recordPeerScene(PeerScene scene, double stepScale = 1);

}  // namespace swept::bench
