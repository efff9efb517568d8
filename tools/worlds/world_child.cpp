#include "world_child.h"

#include <fstream>
#include <optional>
#include <utility>

#include "../reference/child_pipe.h"
#include "../reference/peer_limits.h"
#include "quality_gauge.h"

namespace swept::worlds {
namespace {

constexpr double kPatience = 120;  // seconds; a child silent for so long hangs
constexpr std::size_t kStepNumbers = 7;

enum Command : char { kRun = 'r', kMeasure = 'm', kWeigh = 'w', kMemory = 'k' };

struct Order {
    char command = kRun;
    std::int32_t steps = 0;
};

bool answer(const std::vector<double>& numbers) {
    const std::uint64_t count = numbers.size();
    return writeAll(&count, sizeof count) && writeAll(numbers.data(), count * sizeof(double));
}

/// Peak of the memory of this process that is in use, bytes.
double peakMemory() {
    constexpr double kKilobyte = 1024;
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word == "VmHWM:") {
            double kilobytes = 0;
            status >> kilobytes;
            return kKilobyte * kilobytes;
        }
    }
    return 0;
}

/// The scene that the child was asked for, timed and measured.
class MeasuredRun {
public:
    MeasuredRun(BenchScene bench, const EngineChoice& engine)
        : memoryBefore_(peakMemory()), scripted_(std::move(bench), engine, nullptr) {}

    bool isThere() const { return scripted_.isThere(); }
    double memory() const { return peakMemory() - memoryBefore_; }

    void run(int steps, std::vector<double>& numbers) {
        for (int i = 0; i < steps; ++i) {
            scripted_.step();
            const PeerStages stages = scripted_.world().stages();
            numbers.insert(numbers.end(), {scripted_.world().lastStepSeconds(), stages.pairs, stages.collide,
                                           stages.islands, stages.solve, stages.continuous, stages.finish});
        }
    }

    void weigh(std::vector<double>& numbers) const { numbers = {0, 0, 0, scripted_.world().sample().energy}; }

    void measure(std::vector<double>& numbers) {
        if (!gauge_) { gauge_.emplace(scripted_.bench()); }
        gauge_->add(scripted_.world().sample(), scripted_.isPresent());
        const Quality quality = gauge_->result();
        numbers = {quality.deepest, quality.mean, quality.jointError, quality.energy};
    }

private:
    double memoryBefore_;
    ScriptedWorld scripted_;
    std::optional<QualityGauge> gauge_;
};

}  // namespace

bool WorldChild::start(const WorldRequest& request, const std::string& executable, std::string& error) {
    if (request.engine.isOurs == 0) {
        const SceneEntry* const entry = sceneNamed(request.scene.data());
        const std::string lack = peerLacks(request.engine.peer.engine, entry->make(request.size).scene);
        if (!lack.empty()) {
            error = std::string(peerName(request.engine.peer.engine)) + " has no " + lack;
            return false;
        }
    }
    if (!child_.start(executable, kWorldChildCommand, error)) { return false; }
    char isThere = 0;
    if (!child_.send(&request, sizeof request, kPatience) || !child_.receive(&isThere, 1, kPatience)) {
        error = child_.finish();
        return false;
    }
    return true;
}

bool WorldChild::ask(char command, std::int32_t steps, std::vector<double>& numbers) {
    const Order order{command, steps};
    std::uint64_t count = 0;
    if (!child_.send(&order, sizeof order, kPatience) || !child_.receive(&count, sizeof count, kPatience)) {
        return false;
    }
    numbers.resize(count);
    return child_.receive(numbers.data(), count * sizeof(double), kPatience);
}

bool WorldChild::run(int steps, std::vector<StepTime>& times) {
    std::vector<double> numbers;
    if (!ask(kRun, steps, numbers)) { return false; }
    for (std::size_t i = 0; i + kStepNumbers <= numbers.size(); i += kStepNumbers) {
        const double* const n = &numbers[i];
        times.push_back({n[0], {n[1], n[2], n[3], n[4], n[5], n[6]}});
    }
    return true;
}

bool WorldChild::measure(Quality& quality, bool gathers) {
    std::vector<double> numbers;
    if (!ask(gathers ? kMeasure : kWeigh, 0, numbers)) { return false; }
    quality = {numbers[0], numbers[1], numbers[2], numbers[3]};
    return true;
}

double WorldChild::memory() {
    std::vector<double> numbers;
    return ask(kMemory, 0, numbers) ? numbers[0] : -1;
}

int runWorldChild() {
    forbidDumps();
    WorldRequest request;
    if (!readAll(&request, sizeof request)) { return 2; }
    const SceneEntry* const entry = sceneNamed(request.scene.data());
    if (entry == nullptr) { return 2; }
    MeasuredRun run(entry->make(request.size), request.engine);
    const char isThere = 1;
    if (!run.isThere() || !writeAll(&isThere, 1)) { return 2; }
    std::vector<double> numbers;
    for (Order order; readAll(&order, sizeof order);) {
        numbers.clear();
        switch (order.command) {
            case kRun:
                run.run(order.steps, numbers);
                break;
            case kMeasure:
                run.measure(numbers);
                break;
            case kWeigh:
                run.weigh(numbers);
                break;
            case kMemory:
                numbers = {run.memory()};
                break;
        }
        if (!answer(numbers)) { return 2; }
    }
    return 0;
}

}  // namespace swept::worlds
