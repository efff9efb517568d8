#include "peer_world.h"

#include "box2d_world.h"
#ifdef SWEPT_PEER_BOX2D3
#include "box2d3_world.h"
#endif
#ifdef SWEPT_PEER_CHIPMUNK
#include "chipmunk_world.h"
#endif

namespace swept {

std::unique_ptr<PeerWorld> makePeerWorld(const SceneDescription& scene, const PeerSettings& settings) {
#ifdef SWEPT_PEER_BOX2D3
    if (settings.engine == PeerEngine::box2d3) { return makeBox2d3World(scene, settings); }
#endif
#ifdef SWEPT_PEER_CHIPMUNK
    if (settings.engine == PeerEngine::chipmunk) { return makeChipmunkWorld(scene, settings); }
#endif
    if (settings.engine != PeerEngine::box2d2) { return nullptr; }
    return std::make_unique<Box2dWorld>(scene, settings.iterations);
}

}  // namespace swept
