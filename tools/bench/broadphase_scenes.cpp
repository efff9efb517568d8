#include "broadphase_scenes.h"

#include <algorithm>
#include <cmath>

#include "bench_random.h"
#include "broadphase_contestant.h"

namespace swept::bench {
namespace {

constexpr double kPerSquareMetre = 0.5;
constexpr double kSpeed = 0.1;  // metres a step, at most

/// A box in double, on its way.
struct Mover {
    DVec2 center;
    DVec2 half;
    DVec2 motion;  // a step
    bool isFixed = false;
    int restsFor = 0;  // steps
};

struct Region {
    DVec2 lower;
    DVec2 upper;
};

Region squareFor(double count) {
    const double half = 0.5 * std::sqrt(count / kPerSquareMetre);
    return {{-half, -half}, {half, half}};
}

Region regionOf(BoxScene scene, double count) {
    switch (scene) {
        case BoxScene::oneAxis:
            return {{-count / (8 * kPerSquareMetre), -2}, {count / (8 * kPerSquareMetre), 2}};
        case BoxScene::mixedSizes:
            return squareFor(4 * count);
        case BoxScene::clustered:
            return squareFor(50 * count);
        case BoxScene::uniform:
        case BoxScene::mostlyStatic:
        case BoxScene::mostlyResting:
        case BoxScene::raining:
            return squareFor(count);
    }
    return {};  // unreachable, but GCC cannot know
}

DVec2 pointIn(const Region& region, BenchRandom& random) {
    return {random.in(region.lower.x, region.upper.x), random.in(region.lower.y, region.upper.y)};
}

DVec2 anyMotion(BenchRandom& random) { return {random.in(-kSpeed, kSpeed), random.in(-kSpeed, kSpeed)}; }

/// About a metre wide, with both sides between a half and one and a half.
DVec2 commonHalf(BenchRandom& random) { return {random.in(0.25, 0.75), random.in(0.25, 0.75)}; }

std::vector<Mover> heaps(const Region& region, std::uint32_t count, BenchRandom& random) {
    constexpr std::uint32_t kPerHeap = 200;
    std::vector<Mover> movers;
    while (movers.size() < count) {
        const DVec2 middle = pointIn(region, random);
        for (std::uint32_t i = 0; i < kPerHeap && movers.size() < count; ++i) {
            const double radius = 1.2 * std::sqrt(kPerHeap * random.in(0, 1) / (2 * kPerSquareMetre));
            const double angle = random.in(0, 6.283185307179586);
            const DVec2 at{middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
            movers.push_back({at, commonHalf(random), anyMotion(random)});
        }
    }
    return movers;
}

/// Tiles side by side along the lower edge, one for every ten proxies, and drops above them.
std::vector<Mover> rain(const Region& region, std::uint32_t count, BenchRandom& random) {
    std::vector<Mover> movers;
    const std::uint32_t tiles = std::max(1U, count / 10);
    const double width = (region.upper.x - region.lower.x) / tiles;
    for (std::uint32_t i = 0; i < tiles; ++i) {
        const DVec2 at{region.lower.x + (i + 0.5) * width, region.lower.y - 0.5};
        movers.push_back({at, {0.55 * width, 0.5}, {}, true});
    }
    while (movers.size() < count) {
        movers.push_back({pointIn(region, random), commonHalf(random), {0, -random.in(0.1, 0.3)}});
    }
    return movers;
}

std::vector<Mover> moversOf(BoxScene scene, const Region& region, std::uint32_t count, BenchRandom& random) {
    if (scene == BoxScene::clustered) { return heaps(region, count, random); }
    if (scene == BoxScene::raining) { return rain(region, count, random); }
    std::vector<Mover> movers;
    for (std::uint32_t i = 0; i < count; ++i) {
        Mover mover{pointIn(region, random), commonHalf(random), anyMotion(random)};
        if (scene == BoxScene::mixedSizes) {
            // Pareto's law of exponent 2, cut off at a tenth of the region.
            const double most = 0.1 * (region.upper.x - region.lower.x);
            const double size = std::min(most, 0.7 / std::sqrt(random.in(1e-9, 1)));
            mover.half = {size * mover.half.x, size * mover.half.y};
        }
        mover.isFixed = scene == BoxScene::mostlyStatic && i % 10 != 0;
        if (mover.isFixed || (scene == BoxScene::mostlyResting && i % 20 != 0)) { mover.motion = {}; }
        movers.push_back(mover);
    }
    return movers;
}

void reflect(double& at, double& motion, double lower, double upper) {
    at += motion;
    if (at < lower || at > upper) {
        motion = -motion;
        at = std::clamp(at, lower, upper);
    }
}

/// @return whether it moved
bool advance(Mover& mover, const Region& region, bool falls, BenchRandom& random) {
    constexpr int kLongestRest = 30;
    if (mover.isFixed || mover.motion == DVec2{}) { return false; }
    if (!falls) {
        reflect(mover.center.x, mover.motion.x, region.lower.x, region.upper.x);
        reflect(mover.center.y, mover.motion.y, region.lower.y, region.upper.y);
        return true;
    }
    if (mover.restsFor > 0) {
        if (--mover.restsFor > 0) { return false; }
        mover.center = {random.in(region.lower.x, region.upper.x), region.upper.y};
        return true;
    }
    mover.center = mover.center + mover.motion;
    if (mover.center.y < region.lower.y) { mover.restsFor = 1 + static_cast<int>(random.in(0, kLongestRest)); }
    return true;
}

TightBox tightBox(std::uint32_t proxy, const Mover& mover) {
    const Vec2 motion{static_cast<Real>(mover.motion.x), static_cast<Real>(mover.motion.y)};
    return {proxy, roundedOutward(mover.center - mover.half, mover.center + mover.half), motion};
}

ProxyTraits traitsOf(std::uint32_t proxy, const Mover& mover) {
    ProxyTraits traits;
    traits.kind = mover.isFixed ? ProxyKind::fixed : ProxyKind::dynamic;
    traits.body = proxy;
    traits.extent = static_cast<float>(2 * std::min(mover.half.x, mover.half.y));
    traits.reach = static_cast<float>(std::max(mover.half.x, mover.half.y));
    return traits;
}

}  // namespace

const char* nameOf(BoxScene scene) {
    switch (scene) {
        case BoxScene::uniform:
            return "uniform";
        case BoxScene::clustered:
            return "clustered";
        case BoxScene::oneAxis:
            return "oneAxis";
        case BoxScene::mixedSizes:
            return "mixedSizes";
        case BoxScene::mostlyStatic:
            return "mostlyStatic";
        case BoxScene::mostlyResting:
            return "mostlyResting";
        case BoxScene::raining:
            return "raining";
    }
    return "";  // unreachable, but GCC cannot know
}

Motion makeBoxScene(BoxScene scene, std::uint32_t count, int steps, std::uint64_t seed) {
    BenchRandom random(seed);
    const Region region = regionOf(scene, count);
    std::vector<Mover> movers = moversOf(scene, region, count, random);
    Motion motion;
    motion.name = nameOf(scene);
    MotionStep& first = motion.steps.emplace_back();
    for (std::uint32_t i = 0; i < count; ++i) {
        motion.proxies.push_back(traitsOf(i, movers[i]));
        first.placed.push_back(tightBox(i, movers[i]));
    }
    for (int step = 0; step < steps; ++step) {
        MotionStep& told = motion.steps.emplace_back();
        for (std::uint32_t i = 0; i < count; ++i) {
            if (advance(movers[i], region, scene == BoxScene::raining, random)) {
                told.moved.push_back(tightBox(i, movers[i]));
            }
        }
    }
    return motion;
}

SceneQueries queriesFor(const BoxTrace& trace, int count, std::uint64_t seed) {
    constexpr double kPerQuery = 20;
    BenchRandom random(seed);
    std::vector<Aabb> boxes(trace.proxies.size());
    for (const TraceStep& step : trace.steps) {
        for (const ProxyBox& box : step.inserted) { boxes[box.proxy] = box.box; }
        for (const ProxyBox& box : step.moved) { boxes[box.proxy] = box.box; }
    }
    Region all{toDouble(boxes.front().lower), toDouble(boxes.front().upper)};
    for (const Aabb& box : boxes) {
        all.lower = {std::min(all.lower.x, static_cast<double>(box.lower.x)),
                     std::min(all.lower.y, static_cast<double>(box.lower.y))};
        all.upper = {std::max(all.upper.x, static_cast<double>(box.upper.x)),
                     std::max(all.upper.y, static_cast<double>(box.upper.y))};
    }
    const DVec2 size = all.upper - all.lower;
    const double half = 0.5 * std::sqrt(kPerQuery * size.x * size.y / static_cast<double>(boxes.size()));
    SceneQueries queries;
    for (int i = 0; i < count; ++i) {
        // About a box, so that clusters are asked about as often as they are full.
        const Aabb& near = boxes[static_cast<std::size_t>(random.in(0, 1) * static_cast<double>(boxes.size()))];
        const DVec2 at = 0.5 * (toDouble(near.lower) + toDouble(near.upper));
        queries.boxes.push_back(roundedOutward({at.x - half, at.y - half}, {at.x + half, at.y + half}));
        const double angle = random.in(0, 6.283185307179586);
        const double length = 0.1 * std::max(size.x, size.y);
        queries.rays.push_back({at, {length * std::cos(angle), length * std::sin(angle)}});
    }
    return queries;
}

}  // namespace swept::bench
