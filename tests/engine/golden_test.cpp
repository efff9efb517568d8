#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/world_builder.h>

#include "falling_heap.h"
#include "world_digest.h"
#include "world_support.h"

/// The same bits as when they were last recorded, from every compiler, instruction set and machine: digests of the
/// motion in all built-in scenes, and in heaps that fall, whose numbers no mathematical library had a part in. Where
/// motion was meant to change, run this program with SWEPT_RECORD=1 in the environment and say in the commit what
/// changed and why.

namespace swept::test {
namespace {

constexpr int kSteps = 90;
constexpr double kFastest = 2000;  ///< m/s: bullets of the scenes have 1600, and a scene that bursts is not recorded
constexpr auto kFile =
    sizeof(Real) == sizeof(float) ? SWEPT_TEST_DATA "/golden_f32.csv" : SWEPT_TEST_DATA "/golden_f64.csv";

/// By "scene,profile".
using Digests = std::map<std::string, std::string>;

void addMotion(Digest& digest, const SceneWorld& scene) {
    for (const BodyId id : scene.bodies) {
        digest.add(scene.world.position(id));
        digest.add(scene.world.angle(id));
        digest.add(scene.world.velocity(id));
        digest.add(static_cast<double>(scene.world.angularVelocity(id)));
    }
    for (const JointId id : scene.joints) { digest.add(scene.world.jointForce(id)); }
    for (const ContactEvent& event : scene.world.contactEvents()) {
        digest.add(event.fraction);
        digest.add(event.point);
        digest.add(static_cast<double>(event.impulse));
    }
    for (const LostTimeEntry& entry : scene.world.lostTime()) { digest.add(entry.seconds); }
}

std::string textOf(std::uint64_t digest) {
    std::ostringstream text;
    text << std::hex << std::setfill('0') << std::setw(16) << digest;
    return text.str();
}

std::string digestOfRun(const SceneDescription& description) {
    SceneWorld scene;
    std::string error;
    EXPECT_TRUE(buildWorld(description, scene, error)) << error;
    Digest digest;
    double fastest = 0;
    for (int step = 0; step < kSteps; ++step) {
        must(scene.world.step(kStep));
        addMotion(digest, scene);
        for (const BodyId id : scene.bodies) {
            fastest = std::max(fastest, static_cast<double>(length(scene.world.velocity(id))));
        }
    }
    expectAtMost(description.name + ", m/s", fastest, kFastest);
    return textOf(digest.sum());
}

/// Bytes of a world of everything before its first step: what is written, and how. They change with the members of a
/// world; where members of the same kinds change places or meaning, `kImageVersion` (world_image.cpp) is to change.
std::string digestOfSaved() {
    SceneWorld scene;
    std::string error;
    EXPECT_TRUE(buildWorld(scenes::fallingHeap(7), scene, error)) << error;
    Digest digest;
    for (const std::uint8_t byte : scene.world.save()) { digest.add(std::uint64_t{byte}); }
    return textOf(digest.sum());
}

std::vector<SceneDescription> recordedScenes() {
    std::vector<SceneDescription> recorded;
    for (const BuiltinScene& entry : builtinScenes()) { recorded.push_back(entry.make()); }
    // The one of boxes, the other of everything.
    for (const int seed : {4, 7}) { recorded.push_back(scenes::fallingHeap(seed)); }
    return recorded;
}

Digests digestsNow() {
    Digests digests;
    for (SceneDescription& scene : recordedScenes()) {
        scene.settings.profile = SceneProfile::accurate;
        digests[scene.name + ",accurate"] = digestOfRun(scene);
        scene.settings.profile = SceneProfile::fast;
        digests[scene.name + ",fast"] = digestOfRun(scene);
    }
    digests["heap as saved,accurate"] = digestOfSaved();
    return digests;
}

Digests digestsRecorded() {
    Digests digests;
    std::ifstream in(kFile);
    std::string line;
    std::getline(in, line);  // names of the columns
    while (std::getline(in, line)) { digests[line.substr(0, line.rfind(','))] = line.substr(line.rfind(',') + 1); }
    return digests;
}

TEST(Golden, ScenesMoveAsRecorded) {
    const Digests now = digestsNow();
    if (std::getenv("SWEPT_RECORD") != nullptr) {
        std::ofstream out(kFile);
        out << "scene,profile,digest\n";
        for (const auto& [name, digest] : now) { out << name << ',' << digest << '\n'; }
        ASSERT_TRUE(out.flush()) << kFile;
        return;
    }
    const Digests recorded = digestsRecorded();
    EXPECT_EQ(now.size(), recorded.size());
    for (const auto& [name, digest] : now) {
        const auto found = recorded.find(name);
        ASSERT_NE(found, recorded.end()) << name << " was never recorded";
        EXPECT_EQ(digest, found->second) << name << ": moves otherwise than recorded in " << kFile;
    }
}

}  // namespace
}  // namespace swept::test
