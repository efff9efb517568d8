#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include <swept/toi/time_of_impact.h>

namespace swept::test {

/// One question, whole.
struct Query {
    ToiPolygon a;
    Sweep sweepA;
    ToiPolygon b;
    Sweep sweepB;
    ToiSettings settings;
};

std::ostream& operator<<(std::ostream& out, const Query& query);

inline Toi ask(const Query& q) { return timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings); }
inline Toi askCast(const Query& q) { return shapeCast(q.a, q.sweepA, q.b, q.sweepB, q.settings); }

/// Separation at a fraction, by trying all pairs of features in long double; shares no code with the library.
long double trueSeparation(const Query& query, double fraction);

/// The same without radii: negative when the polygons themselves intersect.
long double trueCoreSeparation(const Query& query, double fraction);

/// Whether an answer keeps its promises, by samples in long double; the other judge, tools/toi/toi_judge.h, proves
/// instead: at no sampled fraction before the answer's the separation is below target − tolerance, at a hit it is
/// within target ± tolerance, and what is reported there is true. Samples lie as close as the separation and the
/// greatest speed demand, but at most some thousands of them.
::testing::AssertionResult keepsItsPromise(const Query& query, const Toi& toi);

/// The query with both rotations left out, as `shapeCast` sees it.
Query withoutRotation(Query query);

}  // namespace swept::test
