#pragma once

#include <cstdint>
#include <string_view>

#include "toi_query.h"

namespace swept {

enum class ToiVerdict : std::uint8_t {
    right,         ///< proved to keep the contract of toi/time_of_impact.h
    missed,        ///< "separated", but the separation falls below target − tolerance
    late,          ///< a hit after, or at, a separation below target − tolerance
    early,         ///< a hit at a separation above target + tolerance
    falseOverlap,  ///< "overlapped", but the polygons do not intersect at the start; or they do, and it is not said
    wrongReport,   ///< the event is right; its separation, normal or witness points are not
    failed,        ///< the method gave up
    undecided,     ///< the oracle gave up: neither proved right nor proved wrong
};

std::string_view nameOf(ToiVerdict verdict);

struct ToiJudgement {
    ToiVerdict verdict = ToiVerdict::undecided;
    double depth = 0;     ///< missed, late: how far below target − tolerance, early: above target + tolerance; metres
    double fraction = 0;  ///< missed, late: one at which the separation is proved to be below; else that of the answer
    int pieces = 0;       ///< work of the oracle
};

/// Judges an answer by interval arithmetic: at every earlier fraction the separation is above target − tolerance, at a
/// hit it is within target ± tolerance (at fraction 0: not above), "overlapped" is said when and only when the polygons
/// intersect at the start, and what is reported is true. Where a contract leaves room for rounding it is a quarter of
/// the tolerance: what is reported, and whether polygons that just touch overlap.
ToiJudgement judgeToi(const ToiQuery& query, const Toi& answer);

/// The same without a look at the reported separation, normal and witness points: for methods that have their own.
ToiJudgement judgeToiEvent(const ToiQuery& query, const Toi& answer);

/// Rotations as (cosine, sine) at both ends of a sweep, for bodies that do not turn at a constant rate: between the
/// ends the two are mixed linearly and normalised. That is less than half a turn, slow at the ends and fast in the
/// middle.
struct MixedTurns {
    DVec2 fromA;
    DVec2 toA;
    DVec2 fromB;
    DVec2 toB;
};

/// The same for bodies that turn so; the angles of the query's sweeps are not looked at.
ToiJudgement judgeToiEvent(const ToiQuery& query, const Toi& answer, const MixedTurns& turns);

}  // namespace swept
