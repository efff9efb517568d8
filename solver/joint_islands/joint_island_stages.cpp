#include <cmath>
#include <cstdint>
#include <limits>

#include "joint_island.h"

/// One sub-step of an island: its drives, its motion to where joints hold, and the speeds that keep them.

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Speeds of this part of those there are are none.
constexpr double kSpeedRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 46);
/// Rounds of Newton's method with one matrix: each takes away all but the part that the bodies turn by. Where a round
/// does not take away half there is nothing to be found.
constexpr int kMostPlaceRounds = 24;
constexpr int kFewestPlaceRounds = 3;
/// Likewise of speeds, which take no more than four unless chains are long: a solve leaves much of the slowest way in
/// which hundreds of links bend.
constexpr int kUsualSpeedRounds = 4;
constexpr int kMostSpeedRounds = 24;

}  // namespace

/// Two of the new ones do what one of the old ones did.
void JointIsland::halveDrives() {
    for (IslandBody& body : bodies_) {
        body.decay = std::sqrt(body.decay);
        body.angularDecay = std::sqrt(body.angularDecay);
        body.gain = 1 / (1 + body.decay) * body.gain;
        body.angularGain /= 1 + body.angularDecay;
    }
}

void JointIsland::drive(double part) {
    for (IslandBody& body : bodies_) {
        body.velocity = body.decay * body.velocity + part * body.gain;
        body.spin = body.angularDecay * body.spin + part * body.angularGain;
    }
}

/// Starts a stage from the forces of the sub-step before; in loops from none. Rows there may depend on each other, and
/// forces that cancel each other would be kept from stage to stage, and grow (two pins on one face: to 10⁹ N).
void JointIsland::pushForces(double time) {
    for (IslandBody& body : bodies_) { body.given = body.turned = 0; }
    if (!isTree_) {
        for (IslandHold& hold : holds_) {
            for (IslandHold::Row& row : hold.rows) { row.impulse = 0; }
        }
        return;
    }
    for (IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) {
            IslandHold::Row& row = hold.rows[i];
            row.impulse = time * row.force;
            push(hold, row, row.impulse);
        }
    }
}

bool JointIsland::reachPlaces(double time) {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMostPlaceRounds; ++round) {
        findPlaces(time);
        const double worst = findGaps(time);
        if (worst <= kNoGapRatio) { return true; }
        if (round >= kFewestPlaceRounds && !(worst <= 0.5 * before)) { return worst <= kLeftGapRatio; }
        before = worst;
        correct(true);
    }
    return false;
}

bool JointIsland::hold() {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMostSpeedRounds; ++round) {
        const double worst = findSpeeds();
        if (worst <= kSpeedRatio) { return true; }
        if (round >= kUsualSpeedRounds && (worst <= kLeftGapRatio || !(worst <= 0.5 * before))) {
            return worst <= kLeftGapRatio;
        }
        before = worst;
        correct(true);
    }
    return false;
}

/// Adds up what the stage took.
void JointIsland::endStage() {
    for (IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) {
            IslandHold::Row& row = hold.rows[i];
            row.total += row.impulse;
            if (hold.kind == IslandHold::Kind::angle) {
                hold.twist += row.impulse;
            } else {
                hold.reaction += row.impulse * DVec2{row.ofB[0], row.ofB[1]};
            }
        }
    }
}

void JointIsland::arrive() {
    for (IslandBody& body : bodies_) { body.place = body.next; }
    placeRows();
    factorise();
}

/// @param part  of the sub-step h that drives were made for; may be negative
bool JointIsland::subStep(double part, double h) {
    ++subSteps_;
    const double time = part * h;
    goOn(time);
    drive(part);
    pushForces(0.5 * time);
    if (!reachPlaces(time)) { return false; }
    endStage();
    for (IslandHold& hold : holds_) {
        for (IslandHold::Row& row : hold.rows) { row.force = row.impulse / time; }
    }
    arrive();
    drive(part);
    pushForces(time);  // as in the stage before
    if (!hold()) { return false; }
    endStage();
    for (IslandHold& hold : holds_) {
        for (IslandHold::Row& row : hold.rows) { row.force += row.impulse / time; }
    }
    return true;
}

void JointIsland::subStepSoftly(double h) {
    ++subSteps_;
    drive(1);
    findSpeeds();
    addGapSpeeds();
    correct(false);
    endStage();
    findPlaces(h);
    goOn(h);
    arrive();
    drive(1);
    findSpeeds();
    correct(false);
    endStage();
}

}  // namespace swept::inline SWEPT_PRECISION
