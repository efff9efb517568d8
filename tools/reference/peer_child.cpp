#include "peer_child.h"

#include <cstdint>
#include <string>

#include <swept/samples/scene_reader.h>

#include "child_pipe.h"
#include "peer_world.h"

namespace swept {
namespace {

bool answer(const PeerWorld& world, std::vector<double>& numbers) {
    encodeSample(world.sample(), numbers);
    const std::uint64_t count = numbers.size();
    return writeAll(&count, sizeof count) && writeAll(numbers.data(), count * sizeof(double));
}

}  // namespace

int runPeerChild() {
    forbidDumps();
    std::uint64_t size = 0;
    if (!readAll(&size, sizeof size)) { return 2; }
    std::string json(size, '\0');
    if (!readAll(json.data(), json.size())) { return 2; }
    const SceneResult result = readScene(json, "scene");
    if (!result.scene) { return 2; }
    PeerSettings settings;
    if (!readAll(&settings, sizeof settings)) { return 2; }
    const std::unique_ptr<PeerWorld> world = makePeerWorld(*result.scene, settings);
    if (!world) { return 2; }
    std::vector<double> numbers;
    bool goesOn = answer(*world, numbers);
    for (char command = 0; goesOn && readAll(&command, 1);) {
        world->step();
        goesOn = answer(*world, numbers);
    }
    return 0;
}

}  // namespace swept
