#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <string>

#include <swept/samples/runner.h>

/// Whole runs, compared bit for bit.

namespace swept::test {

/// How many units of length, mass and time of the second run make one of the first, as powers of two.
struct Units {
    int length = 0;
    int mass = 0;
    int time = 0;
};

inline std::string text(const Units& units) {
    return "units of 2^" + std::to_string(units.length) + " length, 2^" + std::to_string(units.mass) + " mass, 2^" +
           std::to_string(units.time) + " time";
}

struct SceneRun {
    Trace trace;
    bool underflow = false;
};

/// @param tasks  of the world; null: one thread. Underflow is seen on that of the caller only.
inline SceneRun runOf(const SceneDescription& scene, Precision precision, std::int64_t steps,
                      TaskSystem* tasks = nullptr) {
    SceneRun run;
    std::string error;
    std::feclearexcept(FE_ALL_EXCEPT);
    const RunnerOptions options{.precision = precision, .collectEvents = true, .measure = true, .tasks = tasks};
    const auto runner = makeRunner(scene, options, error);
    EXPECT_NE(runner, nullptr) << error;
    if (runner == nullptr) { return run; }
    run.trace = runTrace(*runner, steps, 1, true);
    run.underflow = std::fetestexcept(FE_UNDERFLOW) != 0;
    return run;
}

/// Compares numbers of two runs and remembers the first that differs.
class TraceComparison {
public:
    TraceComparison(const Trace& first, const Trace& second, const Units& units) : units_(units) {
        if (first.frames.size() != second.frames.size()) { note("number of frames"); }
        for (std::size_t i = 0; i < first.frames.size() && difference_.empty(); ++i) {
            step_ = first.frames[i].step;
            compareFrames(first.frames[i], second.frames[i]);
        }
        if (difference_.empty()) { compareEvents(first, second); }
        if (difference_.empty()) { compareReports(first.report, second.report); }
    }

    /// Empty when the runs are the same.
    const std::string& difference() const { return difference_; }

private:
    void note(const std::string& what) {
        if (difference_.empty()) { difference_ = what + " at step " + std::to_string(step_); }
    }

    void same(double a, double b, int length, int mass, int time, const std::string& what) {
        const int power = length * units_.length + mass * units_.mass + time * units_.time;
        const double wanted = std::ldexp(a, power);
        // Zeros of either sign are the same number; anything else must agree in every bit.
        if (std::bit_cast<std::uint64_t>(wanted + 0.0) == std::bit_cast<std::uint64_t>(b + 0.0)) { return; }
        note(what + ": " + testing::PrintToString(wanted) + " against " + testing::PrintToString(b));
    }
    void same(DVec2 a, DVec2 b, int length, int mass, int time, const std::string& what) {
        same(a.x, b.x, length, mass, time, what + ".x");
        same(a.y, b.y, length, mass, time, what + ".y");
    }

    void compareFrames(const Frame& a, const Frame& b) {
        for (std::size_t i = 0; i < a.bodies.size(); ++i) {
            const std::string body = "body " + std::to_string(i) + " ";
            same(a.bodies[i].position, b.bodies[i].position, 1, 0, 0, body + "position");
            same(a.bodies[i].angle, b.bodies[i].angle, 0, 0, 0, body + "angle");
            same(a.bodies[i].velocity, b.bodies[i].velocity, 1, 0, -1, body + "velocity");
            same(a.bodies[i].angularVelocity, b.bodies[i].angularVelocity, 0, 0, -1, body + "angular velocity");
            if (a.bodies[i].awake != b.bodies[i].awake) { note(body + "awake"); }
        }
        if (a.contacts.size() != b.contacts.size()) { return note("number of contact points"); }
        for (std::size_t i = 0; i < a.contacts.size(); ++i) {
            const std::string contact = "contact point " + std::to_string(i) + " ";
            same(a.contacts[i].point, b.contacts[i].point, 1, 0, 0, contact + "point");
            same(a.contacts[i].normal, b.contacts[i].normal, 0, 0, 0, contact + "normal");
            same(a.contacts[i].separation, b.contacts[i].separation, 1, 0, 0, contact + "separation");
            same(a.contacts[i].impulse, b.contacts[i].impulse, 1, 1, -1, contact + "impulse");
        }
        if (a.impacts.size() != b.impacts.size()) { return note("number of impact poses"); }
        for (std::size_t i = 0; i < a.impacts.size(); ++i) {
            same(a.impacts[i].position, b.impacts[i].position, 1, 0, 0, "impact position");
            same(a.impacts[i].angle, b.impacts[i].angle, 0, 0, 0, "impact angle");
        }
    }

    void compareEvents(const Trace& first, const Trace& second) {
        if (first.events.size() != second.events.size()) { return note("number of events"); }
        for (std::size_t i = 0; i < first.events.size(); ++i) {
            const SceneEvent& a = first.events[i];
            const SceneEvent& b = second.events[i];
            step_ = a.step;
            const bool equal = a.step == b.step && a.type == b.type && a.a == b.a && a.b == b.b &&
                               a.shapeA == b.shapeA && a.shapeB == b.shapeB;
            if (!equal) { note("event"); }
            same(a.fraction, b.fraction, 0, 0, 0, "event fraction");
            same(a.point, b.point, 1, 0, 0, "event point");
            same(a.normal, b.normal, 0, 0, 0, "event normal");
            same(a.approachSpeed, b.approachSpeed, 1, 0, -1, "event approach speed");
            same(a.impulse, b.impulse, 1, 1, -1, "event impulse");
        }
    }

    void compareReports(const RunReport& a, const RunReport& b) {
        same(a.deepestPenetration, b.deepestPenetration, 1, 0, 0, "deepest penetration");
        same(a.largestJointError, b.largestJointError, 1, 0, 0, "largest joint error");
        same(a.endEnergy, b.endEnergy, 2, 1, -2, "energy");
        same(a.endMomentum, b.endMomentum, 1, 1, -1, "momentum");
        same(a.endAngularMomentum, b.endAngularMomentum, 2, 1, -1, "angular momentum");
        if (a.lostTime.size() != b.lostTime.size()) { return note("lost-time ledger"); }
        for (std::size_t i = 0; i < a.lostTime.size(); ++i) {
            if (a.lostTime[i].body != b.lostTime[i].body) { note("lost time of another body"); }
            same(a.lostTime[i].seconds, b.lostTime[i].seconds, 0, 0, 1, "lost time");
        }
        compareCounters(a, b);
    }

    void compareCounters(const RunReport& a, const RunReport& b) {
        if (a.counters.size() != b.counters.size()) { return note("number of counters"); }
        for (std::size_t i = 0; i < a.counters.size(); ++i) {
            if (a.counters[i].name == "boxTests") { continue; }  // cost, not behaviour: differs between broadphases
            same(a.counters[i].value, b.counters[i].value, 0, 0, 0, "counter " + a.counters[i].name);
        }
    }

    Units units_;
    std::int64_t step_ = 0;
    std::string difference_;
};

/// What differs first; empty when the second run is the first one told in other units.
inline std::string firstDifference(const Trace& first, const Trace& second, const Units& units = {}) {
    return TraceComparison(first, second, units).difference();
}

}  // namespace swept::test
