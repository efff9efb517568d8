#include "overlap_bench.h"

#include <algorithm>
#include <limits>

#include <swept/shapes/distance.h>

#include "overlap_bodies.h"
#include "stopwatch.h"

namespace swept::bench {
namespace {

Circle placed(const Circle& circle, const Transform& pose) { return {apply(pose, circle.center), circle.radius}; }
Obb placed(const Obb& obb, const Transform& pose) {
    return {{apply(pose, obb.pose.translation), pose.rotation * obb.pose.rotation}, obb.half};
}

bool circlesTouch(const BodyPair& pair) {
    return overlaps(pair.a.circle, placed(pair.b.circle, relativeTransform(pair.a.pose, pair.b.pose)));
}

bool boxesTouch(const BodyPair& pair) { return overlaps(pair.a.box, pair.b.box); }

/// As if nobody had made the boxes before.
bool newBoxesTouch(const BodyPair& pair) {
    const auto boxOf = [](const BoundedBody& body) {
        Aabb box = boundsOf(body.shapes.front(), body.pose);
        for (std::size_t i = 1; i < body.shapes.size(); ++i) { box = hullOf(box, boundsOf(body.shapes[i], body.pose)); }
        return box;
    };
    return overlaps(boxOf(pair.a), boxOf(pair.b));
}

bool obbsTouch(const BodyPair& pair) {
    return overlaps(pair.a.obb, placed(pair.b.obb, relativeTransform(pair.a.pose, pair.b.pose)));
}

/// A box in the world for each shape: what a world does that gives each shape a proxy.
bool shapeBoxesTouch(const BodyPair& pair) {
    for (const Aabb& a : pair.a.boxes) {
        for (const Aabb& b : pair.b.boxes) {
            if (overlaps(a, b)) { return true; }
        }
    }
    return false;
}

/// The body's rectangle first, then the other body's rectangle against each shape's, then shape against shape.
bool hierarchiesTouch(const BodyPair& pair) {
    const Transform bInA = relativeTransform(pair.a.pose, pair.b.pose);
    const Obb whole = placed(pair.b.obb, bInA);
    if (!overlaps(pair.a.obb, whole)) { return false; }
    for (const Obb& b : pair.b.obbs) {
        const Obb inA = placed(b, bInA);
        if (!overlaps(pair.a.obb, inA)) { continue; }
        for (const Obb& a : pair.a.obbs) {
            if (overlaps(a, inA)) { return true; }
        }
    }
    return false;
}

bool gjkTouches(const BodyPair& pair) {
    const Transform bInA = relativeTransform(pair.a.pose, pair.b.pose);
    for (const Polygon& a : pair.a.shapes) {
        for (const Polygon& b : pair.b.shapes) {
            if (distance(a, b, bInA).distance <= 0) { return true; }
        }
    }
    return false;
}

struct Rung {
    const char* name;
    bool (*touch)(const BodyPair&);
    bool onlyCompounds;
};

constexpr Rung kRungs[] = {
    {"circle", circlesTouch, false},
    {"AABB, ready", boxesTouch, false},
    {"AABB, made anew", newBoxesTouch, false},
    {"OBB", obbsTouch, false},
    {"AABB per shape", shapeBoxesTouch, true},
    {"OBB hierarchy", hierarchiesTouch, true},
    {"GJK", gjkTouches, false},
};

/// One rung on all pairs of a family.
struct Judged {
    const Rung* rung = nullptr;
    std::vector<char> passes;
    double seconds = std::numeric_limits<double>::infinity();
};

void judge(Judged& judged, const std::vector<BodyPair>& pairs) {
    const Stopwatch watch;
    for (std::size_t i = 0; i < pairs.size(); ++i) { judged.passes[i] = judged.rung->touch(pairs[i]) ? 1 : 0; }
    judged.seconds = std::min(judged.seconds, watch.seconds());
}

OverlapRow rowOf(const Judged& judged, const Judged& truth, const char* family) {
    const auto all = static_cast<double>(judged.passes.size());
    double passing = 0;
    double falsely = 0;
    double apart = 0;
    OverlapRow row;
    for (std::size_t i = 0; i < judged.passes.size(); ++i) {
        passing += judged.passes[i];
        apart += truth.passes[i] == 0 ? 1 : 0;
        falsely += truth.passes[i] == 0 ? judged.passes[i] : 0;
        row.missesNone = row.missesNone && (judged.passes[i] != 0 || truth.passes[i] == 0);
    }
    row.family = family;
    row.rung = judged.rung->name;
    row.nanoseconds = 1e9 * judged.seconds / all;
    row.passing = passing / all;
    row.falseShare = apart > 0 ? falsely / apart : 0;
    row.withGjk = row.nanoseconds + (&judged == &truth ? 0 : row.passing * 1e9 * truth.seconds / all);
    return row;
}

}  // namespace

std::vector<OverlapRow> benchOverlap(const OverlapBenchSettings& settings) {
    std::vector<OverlapRow> rows;
    for (const OverlapFamily family : kOverlapFamilies) {
        const std::vector<BodyPair> pairs = makeBodyPairs(family, settings.count, settings.seed);
        std::vector<Judged> all;
        for (const Rung& rung : kRungs) {
            if (rung.onlyCompounds && family != OverlapFamily::compounds) { continue; }
            all.push_back({&rung, std::vector<char>(pairs.size())});
        }
        for (int pass = 0; pass < settings.passes; ++pass) {
            for (Judged& judged : all) { judge(judged, pairs); }
        }
        for (const Judged& judged : all) { rows.push_back(rowOf(judged, all.back(), nameOf(family))); }
    }
    return rows;
}

}  // namespace swept::bench
