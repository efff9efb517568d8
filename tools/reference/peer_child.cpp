#include "peer_child.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string>

#include <swept/samples/scene_reader.h>

#include "peer_world.h"

namespace swept {
namespace {

/// Reads exactly `size` bytes; false at the end of the input.
bool readAll(void* target, std::size_t size) {
    auto* bytes = static_cast<char*>(target);
    while (size > 0) {
        const ssize_t count = read(STDIN_FILENO, bytes, size);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        bytes += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

bool writeAll(const void* source, std::size_t size) {
    const auto* bytes = static_cast<const char*>(source);
    while (size > 0) {
        const ssize_t count = write(STDOUT_FILENO, bytes, size);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        bytes += count;
        size -= static_cast<std::size_t>(count);
    }
    return true;
}

bool answer(const PeerWorld& world, std::vector<double>& numbers) {
    encodeSample(world.sample(), numbers);
    const std::uint64_t count = numbers.size();
    return writeAll(&count, sizeof count) && writeAll(numbers.data(), count * sizeof(double));
}

}  // namespace

int runPeerChild() {
    const rlimit noCore{0, 0};  // an abort is a result here, not a crash to be studied
    setrlimit(RLIMIT_CORE, &noCore);
    std::uint64_t size = 0;
    if (!readAll(&size, sizeof size)) {
        return 2;
    }
    std::string json(size, '\0');
    if (!readAll(json.data(), json.size())) {
        return 2;
    }
    const SceneResult result = readScene(json, "scene");
    if (!result.scene) {
        return 2;
    }
    PeerSettings settings;
    if (!readAll(&settings, sizeof settings)) {
        return 2;
    }
    const std::unique_ptr<PeerWorld> world = makePeerWorld(*result.scene, settings);
    if (!world) {
        return 2;
    }
    std::vector<double> numbers;
    bool goesOn = answer(*world, numbers);
    for (char command = 0; goesOn && readAll(&command, 1);) {
        world->step();
        goesOn = answer(*world, numbers);
    }
    return 0;
}

}  // namespace swept
