#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include <swept/tools/reference/peer_limits.h>
#include <swept/tools/task_threads.h>
#include <swept/tools/worlds/scripted_world.h>
#include <swept/tools/worlds/threads_bench.h>

// What is measured on several threads is the same work as on one.

namespace swept::worlds {
namespace {

/// Where the bodies of a scene are after some steps.
std::vector<DVec2> placesAfter(int steps, const BenchScene& bench, const EngineChoice& engine, TaskSystem* tasks) {
    ScriptedWorld scripted(bench, engine, tasks);
    for (int i = 0; scripted.isThere() && i < steps; ++i) { scripted.step(); }
    std::vector<DVec2> places;
    if (!scripted.isThere()) { return places; }
    for (const BodyFrame& body : scripted.world().sample().frame.bodies) { places.push_back(body.position); }
    return places;
}

void expectSamePlaces(const std::vector<DVec2>& one, const std::vector<DVec2>& several, const std::string& scene) {
    ASSERT_FALSE(one.empty()) << scene;
    ASSERT_EQ(one.size(), several.size()) << scene;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].x, several[i].x) << scene << ", body " << i;
        EXPECT_EQ(one[i].y, several[i].y) << scene << ", body " << i;
    }
}

/// A heap that is large enough to be shared, and figures that a script adds and takes away.
std::vector<BenchScene> scenes() { return {growingScenes()[1].make(1000), sceneNamed("rain")->make(0.02)}; }

TEST(ThreadsBench, OursMovesAsOnOneThread) {
    const std::unique_ptr<TaskSystem> tasks = makeTaskSystem(2);
    if (tasks == nullptr) { GTEST_SKIP() << "built without oneTBB"; }
    EngineChoice ours;
    ours.isOurs = 1;
    ours.profile = SceneProfile::fast;
    for (const BenchScene& bench : scenes()) {
        expectSamePlaces(placesAfter(40, bench, ours, nullptr), placesAfter(40, bench, ours, tasks.get()),
                         bench.scene.name);
    }
}

TEST(ThreadsBench, Box2d3MovesAsOnOneThread) {
    if (!hasPeer(PeerEngine::box2d3)) { GTEST_SKIP() << "Box2D 3 was not found"; }
    EngineChoice one;
    one.peer.engine = PeerEngine::box2d3;
    EngineChoice several = one;
    several.peer.threads = 2;
    for (const BenchScene& bench : scenes()) {
        expectSamePlaces(placesAfter(40, bench, one, nullptr), placesAfter(40, bench, several, nullptr),
                         bench.scene.name);
    }
}

TEST(ThreadsBench, RowsAreThoseOfTheSettings) {
    ThreadsBenchSettings settings;
    settings.fewestBodies = 10;
    settings.mostBodies = 100;
    settings.ownAlone = true;
    EXPECT_EQ(threadsRowCount(settings), 3U * 3 + 10) << "three growing scenes of 10, 30 and 100, and the published";
    settings.scenes = {"heap", "tray"};
    EXPECT_EQ(threadsRowCount(settings), 3U + 1);
    settings.ownAlone = false;
    EXPECT_EQ(threadsRowCount(settings), 2U * (3 + 1));
    settings.mostBodies = 9;
    settings.scenes = {"heap"};
    EXPECT_EQ(threadsRowCount(settings), 0U);
}

}  // namespace
}  // namespace swept::worlds
