#pragma once

#include <cstdint>

namespace swept {

/// The engines that run in a child process. Box2D 2.4.1 is always there, the others when they were found at build time.
enum class PeerEngine : std::int32_t { box2d2, box2d3, chipmunk };

/// How hard Box2D 2.4.1 tries in a step.
struct Box2dIterations {
    std::int32_t velocity = 8;
    std::int32_t position = 3;
};

/// An engine and how hard it tries in a step. Sent to the child as it is: both ends are the same program.
struct PeerSettings {
    PeerEngine engine = PeerEngine::box2d2;
    Box2dIterations iterations;      ///< of Box2D 2.4.1
    std::int32_t subSteps = 4;       ///< of Box2D 3; its own advice
    std::int32_t isStiff = 0;        ///< Box2D 3: 1 for contacts and joints as stiff as its sub-steps allow
    std::int32_t threads = 1;        ///< of Box2D 3, on oneTBB; without that it stays on the calling one
    std::int32_t solverPasses = 10;  ///< of Chipmunk; its default
};

}  // namespace swept
