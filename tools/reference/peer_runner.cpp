#include "peer_runner.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <swept/samples/scene_reader.h>

#include "../writers/finite_state.h"
#include "box2d_runner.h"
#include "child_process.h"
#include "peer_child.h"
#include "peer_limits.h"
#include "peer_sample.h"

namespace swept {
namespace {

// A step of the largest scene takes far below a second; a child silent for so long hangs.
constexpr double kPatience = 60;  // seconds

/// The initial state as the scene gives it, for a world that the engine refused to build.
PeerSample initialSample(const SceneDescription& scene) {
    PeerSample sample;
    for (const BodyDescription& body : scene.bodies) {
        const bool awake = body.awake && body.type != SceneBodyType::fixed;
        sample.frame.bodies.push_back({body.position, body.angle, body.velocity, body.angularVelocity, awake});
    }
    return sample;
}

class ChildRunner final : public PeerRunner {
public:
    ChildRunner(const SceneDescription& scene, const PeerSettings& settings)
        : engine_(settings.engine),
          sample_(initialSample(scene)),
          approximations_(peerApproximations(settings.engine, scene)) {}

    bool start(const SceneDescription& scene, const PeerSettings& settings, const std::string& executable,
               std::string& error) {
        if (!child_.start(executable, kPeerChildCommand, error)) { return false; }
        const std::string json = writeScene(scene);
        const std::uint64_t size = json.size();
        const bool sent = child_.send(&size, sizeof size, kPatience) &&
                          child_.send(json.data(), json.size(), kPatience) &&
                          child_.send(&settings, sizeof settings, kPatience);
        if (!sent || !receiveSample()) { noteEnd("while the world was built"); }
        report_.startEnergy = report_.endEnergy;
        report_.startMomentum = report_.endMomentum;
        report_.startAngularMomentum = report_.endAngularMomentum;
        return true;
    }

    bool step() override {
        if (aborted_) { return true; }
        const std::int64_t next = sample_.frame.step + 1;
        const char go = 's';
        if (!child_.send(&go, 1, kPatience) || !receiveSample()) { noteEnd("at step " + std::to_string(next)); }
        return true;
    }

    void read(Frame& frame, bool withContacts) const override {
        frame.step = sample_.frame.step;
        frame.time = sample_.frame.time;
        frame.bodies = sample_.frame.bodies;
        frame.impacts.clear();
        frame.contacts.clear();
        if (withContacts) { frame.contacts = sample_.frame.contacts; }
    }

    const std::vector<SceneEvent>& events() const override { return noEvents_; }
    RunReport report() const override { return report_; }
    std::vector<std::string> approximations() const override { return approximations_; }
    const std::optional<std::string>& aborted() const override { return aborted_; }
    double stepSeconds() const override { return sample_.stepSeconds; }

private:
    bool receiveSample() {
        std::uint64_t count = 0;
        if (!child_.receive(&count, sizeof count, kPatience)) { return false; }
        numbers_.resize(count);
        if (!child_.receive(numbers_.data(), count * sizeof(double), kPatience)) { return false; }
        std::optional<PeerSample> sample = decodeSample(numbers_);
        if (!sample) { return false; }
        sample_ = std::move(*sample);
        addToReport();
        return true;
    }

    void addToReport() {
        report_.deepestPenetration = std::max(report_.deepestPenetration, sample_.penetration);
        report_.largestJointError = std::max(report_.largestJointError, sample_.jointError);
        report_.endEnergy = sample_.energy;
        report_.endMomentum = sample_.momentum;
        report_.endAngularMomentum = sample_.angularMomentum;
        report_.finite = report_.finite && !firstNotFinite(sample_.frame);
        report_.counters = {{"brokenJoints", static_cast<double>(sample_.brokenJoints)}};
    }

    void noteEnd(const std::string& when) {
        aborted_ = std::string(peerName(engine_)) + ' ' + withMoment(child_.finish(), when);
    }

    /// "aborted (why)" and "at step 3" make "aborted at step 3 (why)".
    static std::string withMoment(const std::string& ending, const std::string& when) {
        const std::size_t reason = ending.find(" (");
        if (reason == std::string::npos) { return ending + ' ' + when; }
        return ending.substr(0, reason) + ' ' + when + ending.substr(reason);
    }

    PeerEngine engine_;
    ChildProcess child_;
    PeerSample sample_;
    std::vector<double> numbers_;
    RunReport report_;
    std::vector<SceneEvent> noEvents_;
    std::vector<std::string> approximations_;
    std::optional<std::string> aborted_;
};

}  // namespace

std::unique_ptr<PeerRunner> makePeerRunner(const SceneDescription& scene, const PeerSettings& settings,
                                           std::string& error, const std::string& executable) {
    const std::string lack = peerLacks(settings.engine, scene);
    if (!lack.empty()) {
        error = std::string(peerName(settings.engine)) + " has no " + lack;
        return nullptr;
    }
    auto runner = std::make_unique<ChildRunner>(scene, settings);
    if (!runner->start(scene, settings, executable, error)) { return nullptr; }
    return runner;
}

std::unique_ptr<Box2dRunner> makeBox2dRunner(const SceneDescription& scene, std::string& error,
                                             const Box2dIterations& iterations, const std::string& executable) {
    PeerSettings settings;
    settings.iterations = iterations;
    return makePeerRunner(scene, settings, error, executable);
}

Box2dIterations iterationsOf(int velocity) {
    const Box2dIterations usual;
    return {velocity, std::max(1, velocity * usual.position / usual.velocity)};
}

}  // namespace swept
