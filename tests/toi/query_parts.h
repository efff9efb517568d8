#pragma once

#include <swept/toi/toi_method.h>

#include "oracle.h"

/// What suites make queries of.

namespace swept::test {

inline ToiPolygon circle(double radius) {
    ToiPolygon polygon;
    polygon.count = 1;
    polygon.radius = radius;
    return polygon;
}

/// The same question about all that is `factor` times as large.
inline Query scaled(Query q, double factor) {
    for (ToiPolygon* polygon : {&q.a, &q.b}) {
        for (DVec2& vertex : polygon->vertices) { vertex = factor * vertex; }
        polygon->radius *= factor;
    }
    for (Sweep* sweep : {&q.sweepA, &q.sweepB}) {
        for (DVec2* v : {&sweep->localCenter, &sweep->c0, &sweep->c1, &sweep->k}) { *v = factor * *v; }
    }
    q.settings.target *= factor;
    q.settings.tolerance *= factor;
    return q;
}

inline Toi by(ToiMethod method, const Query& q) {
    return timeOfImpactBy(method, q.a, q.sweepA, q.b, q.sweepB, q.settings);
}

}  // namespace swept::test
