#include "toi_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../tests/oracle/first_crossing.h"

namespace swept {
namespace {

using oracle::Crossing;
using oracle::CrossingState;
using oracle::Interval;
using oracle::MovingPair;

/// Any proof of a crossing is enough: no bracket is wanted.
constexpr oracle::CrossingSettings kAnyCrossing{1, 20'000};

double lowest(const ToiSettings& s) { return (Interval(s.target) - Interval(s.tolerance)).lo; }
double highest(const ToiSettings& s) { return (Interval(s.target) + Interval(s.tolerance)).hi; }

/// How deep a wrong answer let the shapes in until its fraction: the best of some samples.
double deepest(const MovingPair& pair, double level, double from, double to) {
    constexpr int kSamples = 256;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSamples; ++i) {
        least = std::min(least, pair.guessSeparation(from + (to - from) * i / kSamples));
    }
    return std::max(0.0, level - least);
}

/// Whether separation stays above target − tolerance on [0, answer.fraction].
ToiJudgement judgeTheWay(const MovingPair& pair, const ToiQuery& query, const Toi& answer) {
    const double level = lowest(query.settings);
    const Crossing crossing = firstCrossing(pair, level, 0, answer.fraction, kAnyCrossing);
    switch (crossing.state) {
        case CrossingState::none:
            return {ToiVerdict::right, 0, answer.fraction, crossing.pieces};
        case CrossingState::undecided:
            return {ToiVerdict::undecided, 0, crossing.lo, crossing.pieces};
        case CrossingState::found:
            break;
    }
    const ToiVerdict verdict = answer.state == ToiState::separated ? ToiVerdict::missed : ToiVerdict::late;
    return {verdict, deepest(pair, level, crossing.lo, answer.fraction), crossing.hi, crossing.pieces};
}

ToiJudgement judgeOverlap(const MovingPair& pair, const ToiQuery& query, const Toi& answer) {
    const Interval core = pair.coreSeparationAt(0);
    const double room = 0.25 * query.settings.tolerance;
    const bool said = answer.state == ToiState::overlapped;
    if (said && answer.fraction != 0) { return {ToiVerdict::wrongReport, 0, answer.fraction, 0}; }
    if (said ? core.above(room) : core.below(-room)) { return {ToiVerdict::falseOverlap, core.magnitude(), 0, 0}; }
    const bool sure = said ? core.hi <= room : core.lo >= -room;
    return {sure ? ToiVerdict::right : ToiVerdict::undecided, 0, 0, 0};
}

ToiJudgement judgeHitSeparation(const MovingPair& pair, const ToiQuery& query, const Toi& answer) {
    const Interval there = pair.separationAt(answer.fraction);
    const double most = highest(query.settings);
    if (there.above(most)) { return {ToiVerdict::early, there.lo - most, answer.fraction, 0}; }
    return {there.hi <= most ? ToiVerdict::right : ToiVerdict::undecided, 0, answer.fraction, 0};
}

/// What a world coordinate of the answer may be off by: some roundings at the distance from the origin.
double coordinateRoom(const ToiQuery& q) {
    double largest = 0;
    for (const Sweep* s : {&q.sweepA, &q.sweepB}) { largest += length(s->c0) + length(s->c1) + length(s->k); }
    return 8 * std::numeric_limits<double>::epsilon() * largest;
}

bool reportIsTrue(const MovingPair& pair, const ToiQuery& query, const Toi& answer) {
    const double room = 0.25 * query.settings.tolerance;
    const Interval there = pair.separationAt(answer.fraction);
    if (!(there.lo - room <= answer.separation && answer.separation <= there.hi + room)) { return false; }
    if (!(std::fabs(length(answer.normal) - 1) < 1e-14)) { return false; }
    if (!(pair.gapAt(answer.fraction, {answer.normal.x, answer.normal.y}) >= answer.separation - room)) {
        return false;
    }
    if (answer.state == ToiState::overlapped) { return true; }
    const DVec2 wrong = (answer.pointB - answer.pointA) - answer.separation * answer.normal;
    return length(wrong) <= room + coordinateRoom(query);
}

bool isWithinTheSweep(const ToiQuery& query, const Toi& answer) {
    if (answer.state == ToiState::separated) { return answer.fraction == query.settings.tMax; }
    return answer.fraction >= 0 && answer.fraction <= query.settings.tMax;
}

ToiJudgement judgeEvent(const MovingPair& pair, const ToiQuery& query, const Toi& answer) {
    if (answer.state == ToiState::failed) { return {ToiVerdict::failed, 0, answer.fraction, 0}; }
    if (!isWithinTheSweep(query, answer)) { return {ToiVerdict::wrongReport, 0, answer.fraction, 0}; }
    const ToiJudgement overlap = judgeOverlap(pair, query, answer);
    if (overlap.verdict != ToiVerdict::right || answer.state == ToiState::overlapped) { return overlap; }
    if (answer.state == ToiState::hit) {
        const ToiJudgement there = judgeHitSeparation(pair, query, answer);
        // A hit at the start may be as deep as it likes.
        if (there.verdict != ToiVerdict::right || answer.fraction == 0) { return there; }
    }
    return judgeTheWay(pair, query, answer);
}

}  // namespace

std::string_view nameOf(ToiVerdict verdict) {
    switch (verdict) {
        case ToiVerdict::right:
            return "right";
        case ToiVerdict::missed:
            return "missed";
        case ToiVerdict::late:
            return "late";
        case ToiVerdict::early:
            return "early";
        case ToiVerdict::falseOverlap:
            return "falseOverlap";
        case ToiVerdict::wrongReport:
            return "wrongReport";
        case ToiVerdict::failed:
            return "failed";
        case ToiVerdict::undecided:
            return "undecided";
    }
    return "";  // unreachable, but GCC cannot know
}

ToiJudgement judgeToiEvent(const ToiQuery& query, const Toi& answer) {
    return judgeEvent(MovingPair(query.a, query.sweepA, query.b, query.sweepB), query, answer);
}

ToiJudgement judgeToiEvent(const ToiQuery& query, const Toi& answer, const MixedTurns& turns) {
    using oracle::plain;
    const auto turningA = oracle::Turning::mixed(plain(turns.fromA), plain(turns.toA));
    const auto turningB = oracle::Turning::mixed(plain(turns.fromB), plain(turns.toB));
    return judgeEvent(MovingPair(query.a, query.sweepA, turningA, query.b, query.sweepB, turningB), query, answer);
}

ToiJudgement judgeToi(const ToiQuery& query, const Toi& answer) {
    const MovingPair pair(query.a, query.sweepA, query.b, query.sweepB);
    ToiJudgement judgement = judgeEvent(pair, query, answer);
    if (judgement.verdict == ToiVerdict::right && !reportIsTrue(pair, query, answer)) {
        judgement.verdict = ToiVerdict::wrongReport;
    }
    return judgement;
}

}  // namespace swept
