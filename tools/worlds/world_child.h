#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "../reference/child_process.h"
#include "quality.h"
#include "scripted_world.h"

namespace swept::worlds {

/// Name of the hidden sub-command that runs the child.
inline constexpr const char* kWorldChildCommand = "__world";

/// Which scene in which engine. Sent to the child as it is: both ends are the same program.
struct WorldRequest {
    static constexpr std::size_t kNameSize = 32;
    std::array<char, kNameSize> scene{};  ///< name, ended by a zero
    double size = 1;
    EngineChoice engine;
};

/// One step of a run.
struct StepTime {
    double seconds = 0;  ///< processor time
    PeerStages stages;
};

/// A run of one scene in one engine, in a process of its own: the others abort on some input, and memory is told by
/// process.
class WorldChild {
public:
    /// @return false, and a reason in `error`, when no child could be started or the engine cannot have the scene
    bool start(const WorldRequest& request, const std::string& executable, std::string& error);
    /// Appends so many steps. @return false when the child has ended
    bool run(int steps, std::vector<StepTime>& times);
    /// Measures the present state. @param gathers  adds it to those measured so before; else the energy alone is told
    /// @return false when the child has ended
    bool measure(Quality& quality, bool gathers);
    /// Most memory used so far beyond what was used before the world was built, bytes; negative when the child has
    /// ended
    double memory();
    std::string finish() { return child_.finish(); }

private:
    bool ask(char command, std::int32_t steps, std::vector<double>& numbers);

    ChildProcess child_;
};

/// The child's side. @return exit code: 0, or 2 when the scene or the engine is not there
int runWorldChild();

}  // namespace swept::worlds
