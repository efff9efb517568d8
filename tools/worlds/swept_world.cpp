#include "swept_world.h"

// Each precision contributes one adapter (swept_world_adapter.cpp, compiled twice). Not inline here, so that both can
// be named.
namespace swept::f32 {
std::unique_ptr<PeerWorld> makeSweptPeer(const SceneDescription& scene, TaskSystem* tasks, std::string& error);
}
namespace swept::f64 {
std::unique_ptr<PeerWorld> makeSweptPeer(const SceneDescription& scene, TaskSystem* tasks, std::string& error);
}

namespace swept::worlds {

std::unique_ptr<PeerWorld> makeSweptWorld(const SceneDescription& scene, Precision precision, TaskSystem* tasks,
                                          std::string& error) {
    switch (precision) {
        case Precision::f32:
            return f32::makeSweptPeer(scene, tasks, error);
        case Precision::f64:
            return f64::makeSweptPeer(scene, tasks, error);
    }
    return nullptr;  // unreachable, but GCC cannot know
}

}  // namespace swept::worlds
