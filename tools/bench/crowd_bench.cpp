#include "crowd_bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include <swept/samples/scene_builder.h>

#include "../writers/number_text.h"
#include "crowd.h"
#include "stopwatch.h"
#ifdef SWEPT_BENCH_BOX2D3
#include "box2d3/box2d3_crowd.h"
#endif

namespace swept::bench {
namespace {

constexpr int kBodies = 1000;
constexpr int kSteps = 60;
constexpr int kCrowdTurns = 3;

void addBox(Crowd& crowd, double half) {
    crowd.half = half;
    for (const double side : {-half, half}) {
        crowd.walls.push_back({{side, -half}, {side, half}});
        crowd.walls.push_back({{-half, side}, {half, side}});
    }
}

/// On a square grid, so that no two overlap at the start.
void addBodies(Crowd& crowd, double half, double speed, double spin, build::Dice& dice) {
    const int side = static_cast<int>(std::ceil(std::sqrt(kBodies)));
    for (int i = 0; i < kBodies; ++i) {
        const double aim = dice.range(0, 2 * std::numbers::pi);
        const double spacing = 2 * half / (side + 1);
        crowd.bodies.push_back({.isDisk = i % 2 == 0,
                                .place = {-half + spacing * (1 + i % side), -half + spacing * (1 + i / side)},
                                .angle = dice.range(0, 2 * std::numbers::pi),
                                .velocity = {speed * std::cos(aim), speed * std::sin(aim)},
                                .spin = dice.range(-spin, spin)});
    }
}

Crowd storm(build::Dice& dice) {
    Crowd crowd{.name = "storm: 1000 at 50 m/s"};
    addBox(crowd, 20);
    addBodies(crowd, 20, 50, 10, dice);
    return crowd;
}

Crowd slow(build::Dice& dice) {
    Crowd crowd{.name = "1000 at 0.5 m/s"};
    addBox(crowd, 20);
    addBodies(crowd, 20, 0.5, 1, dice);
    return crowd;
}

/// A segment of 1 m in the middle of each cell of 2 m, turned at random; bodies start between the cells.
Crowd segments(build::Dice& dice) {
    constexpr int kCells = 100;
    Crowd crowd{.name = "1000 at 50 m/s, 10 000 segments", .bodiesMeet = false};
    addBox(crowd, kCells);
    for (int i = 0; i < kCells * kCells; ++i) {
        const DVec2 middle{2.0 * (i % kCells) - kCells + 1, 2.0 * (i / kCells) - kCells + 1};
        const double angle = dice.range(0, std::numbers::pi);
        const DVec2 arm{0.5 * std::cos(angle), 0.5 * std::sin(angle)};
        crowd.walls.push_back({middle - arm, middle + arm});
    }
    addBodies(crowd, kCells, 50, 10, dice);
    for (CrowdBody& body : crowd.bodies) {
        body.place = {2 * std::round(body.place.x / 2), 2 * std::round(body.place.y / 2)};
    }
    return crowd;
}

double energyOf(const Crowd& crowd, const std::vector<CrowdBody>& bodies) {
    double energy = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool isDisk = crowd.bodies[i].isDisk;
        const double area = (isDisk ? std::numbers::pi : 4) * kCrowdRadius * kCrowdRadius;
        const double gyration = (isDisk ? 1.0 / 2 : 2.0 / 3) * kCrowdRadius * kCrowdRadius;
        const CrowdBody& body = bodies[i];
        energy += 0.5 * area * kCrowdDensity * (dot(body.velocity, body.velocity) + gyration * body.spin * body.spin);
    }
    return energy;
}

std::vector<std::unique_ptr<CrowdEngine>> engines() {
    std::vector<std::unique_ptr<CrowdEngine>> result;
    for (const CrowdSweeps sweeps : {CrowdSweeps::walls, CrowdSweeps::everything, CrowdSweeps::nothing}) {
        result.push_back(makeSweptCrowd(sweeps));
    }
#ifdef SWEPT_BENCH_BOX2D3
    result.push_back(makeBox2d3Crowd());
#endif
    result.push_back(makeBox2dCrowd());
    return result;
}

/// All engines in turn, several times, since the machine is not equally fast at all times.
std::vector<CrowdRow> measure(const Crowd& crowd) {
    std::vector<CrowdRow> rows;
    const auto all = engines();
    for (const auto& engine : all) {
        rows.push_back({.crowd = crowd.name, .engine = engine->name()});
        rows.back().microseconds = std::numeric_limits<double>::infinity();
    }
    for (int turn = 0; turn < kCrowdTurns; ++turn) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i]->begin(crowd);
            const Stopwatch watch;
            for (int step = 0; step < kSteps; ++step) { all[i]->step(); }
            rows[i].microseconds = std::min(rows[i].microseconds, 1e6 * watch.seconds() / kSteps);
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::vector<CrowdBody> end = all[i]->bodies();
        const auto left = std::count_if(end.begin(), end.end(), [&](const CrowdBody& body) {
            return std::max(std::fabs(body.place.x), std::fabs(body.place.y)) > crowd.half;
        });
        rows[i].nanoseconds = 1e3 * rows[i].microseconds / kBodies;
        rows[i].outside = static_cast<double>(left) / kBodies;
        rows[i].energyError = energyOf(crowd, end) / energyOf(crowd, crowd.bodies) - 1;
        const double lost = all[i]->lostSeconds();
        rows[i].lost = lost < 0 ? -1 : lost / (kBodies * kSteps / 60.0);
    }
    return rows;
}

std::string percentOrNone(double share) { return share == 0 ? "0" : roundedText(100 * share, 3) + " %"; }

}  // namespace

std::vector<CrowdRow> benchCrowds(const ContinuousBenchSettings& settings, const std::function<void(int)>& progress) {
    build::Dice dice(settings.seed);
    std::vector<CrowdRow> rows;
    int done = 0;
    for (const auto& make : {storm, segments, slow}) {
        const std::vector<CrowdRow> some = measure(make(dice));
        rows.insert(rows.end(), some.begin(), some.end());
        progress(++done);
    }
    return rows;
}

void writeCrowdTable(std::ostream& out, const std::vector<CrowdRow>& rows) {
    out << "| crowd, 1 s | engine | µs a step | ns a body-step | outside | energy | time lost |\n"
           "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const CrowdRow& row : rows) {
        out << "| " << row.crowd << " | " << row.engine << " | " << roundedText(row.microseconds, 3) << " | "
            << roundedText(row.nanoseconds, 3) << " | " << percentOrNone(row.outside) << " | "
            << percentOrNone(row.energyError) << " | " << (row.lost < 0 ? "-" : percentOrNone(row.lost)) << " |\n";
    }
}

void writeCrowdCsv(std::ostream& out, const std::vector<CrowdRow>& rows) {
    for (const CrowdRow& row : rows) {
        const auto cell = [&](const char* column, double value) {
            out << "\"crowd: " << row.crowd << "\",\"" << row.engine << "\"," << column << ',' << roundedText(value, 9)
                << "\r\n";
        };
        cell("nanosecondsPerBodyStep", row.nanoseconds);
        cell("outside", row.outside);
        cell("energyError", row.energyError);
        if (row.lost >= 0) { cell("lost", row.lost); }
    }
}

}  // namespace swept::bench
