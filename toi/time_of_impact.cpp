#include "time_of_impact.h"

#include <algorithm>

#include "../shapes/compiler.h"
#include "axis_bound.h"
#include "moving_pair.h"
#include "toi_observer.h"

namespace swept {
namespace {

/// Each step is certified and gains time. Two or three distances are typical.
/// Beyond the budget the answer is `failed`.
constexpr int kMaxDistances = 1024;
/// After so many distances each vertex is bounded by its own swing: a little dearer, and needed where shapes are long
/// and touch near the point they turn about. Of 800 000 queries of all families none came so far (59 was the most).
constexpr int kPatience = 64;
/// After so many looks along one axis the next distance will know a better one.
constexpr int kLooksPerAxis = 8;
/// A first step of this part of the time that is left is good enough not to
/// look at other holders of the axis.
constexpr double kGoodStep = 1.0 / 512;

DVec2 toWorld(Rotation rotation, DVec2 v) {
    const Vec2 world = rotate(rotation, {v.x, v.y});
    return {world.x, world.y};
}

/// The features that a simplex names, as seen from one of the shapes.
ToiFeature featureOf(int first, int second) {
    if (first == second) { return {first, -1}; }
    return {first, second};
}

/// Beyond it squares of lengths come near the end of what doubles hold. A smaller tolerance than was asked for does no
/// harm, as long as rounding leaves room for it (`validateToi` asks for four times the slack).
double boundedTolerance(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                        double tolerance) {
    constexpr double kLargest = 0x1p400;
    if (!(tolerance > kLargest)) { return tolerance; }
    return std::min(tolerance, std::max(kLargest, 8 * roundingSlack(a, sweepA, b, sweepB)));
}

/// One search: where it stands, and what it has proved.
class Search {
public:
    Search(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
           const ToiSettings& settings)
        : pair_(a, sweepA, b, sweepB),
          sweepA_(sweepA),
          settings_(settings),
          tolerance_(boundedTolerance(a, sweepA, b, sweepB, settings.tolerance)) {
        setTarget(settings.target);
    }

    Toi run() {
        // Up to here the circles that hold the bodies stay apart.
        const double start = advanceOfCircles(pair_, 0, target_, settings_.tMax);
        if (start >= settings_.tMax) { return separated(); }
        pose_ = pair_.poseAt(start);
        findClosest();
        if (pose_.fraction <= 0 && closest_.coresOverlap()) { return overlapped(); }
        if (closest_.isDeep()) { pair_.measureOverlap(pose_, closest_); }
        return search();
    }

    Toi runInContact(DVec2 axis) {
        inContact_ = true;
        pose_ = pair_.poseAt(0);
        remembered_ = hold(pair_, pose_, Vec2{axis.x, axis.y}, AxisOwner::a);
        look();
        setTarget(std::min(target_, closest_.separation - 2 * tolerance_));
        return search();
    }

    Toi separationAt(double fraction) {
        pose_ = pair_.poseAt(fraction);
        look();
        return answer(closest_.coresOverlap() ? ToiState::overlapped : ToiState::separated);
    }

private:
    enum class End : std::uint8_t { free, hit, touching, stuck, newAxis };

    void setTarget(double target) {
        target_ = target;
        // Steps aim half a tolerance below the target and end half a tolerance
        // above it: the band between is wide enough for the last step to land in,
        // and what is left on either side is for rounding.
        level_ = target - 0.5 * tolerance_;
        closeEnough_ = target + 0.5 * tolerance_;
    }

    Toi search() {
        separationLower_ = closest_.separation;
        fractionLower_ = pose_.fraction;
        while (iterations_ < kMaxDistances) {
            if (closest_.separation <= target_) { return answer(ToiState::hit); }
            if (!(pose_.fraction < settings_.tMax)) { return separated(); }
            switch (followAxis()) {
                case End::free:
                    return separated();
                case End::hit:
                    return answer(ToiState::hit);
                case End::touching:
                    return answerOnFace();
                case End::stuck:
                    return answer(ToiState::failed);
                case End::newAxis:
                    look();
            }
        }
        return answer(ToiState::failed);
    }

    void findClosest() {
        pair_.findClosest(pose_, cache_, closest_);
        ++iterations_;
    }

    /// Separation and closest direction at the pose.
    void look() {
        findClosest();
        if (inContact_ && closest_.isApart()) {
            remembered_ = hold(pair_, pose_, closest_, closest_.owner);
        } else if (inContact_) {
            lookAlongRemembered();
        } else if (closest_.isDeep()) {
            pair_.measureOverlap(pose_, closest_);
        }
    }

    void lookAlongRemembered() {
        remembered_ = hold(pair_, pose_, directionAt(pose_, remembered_), remembered_.holder);
        closest_.gjk.encloses = false;  // measured, that is: not by its depth, but by this
        closest_.coreSeparation = remembered_.gap;
        closest_.separation = remembered_.gap - pair_.radii;
        closest_.normal = remembered_.inA;
        closest_.owner = remembered_.holder;
        const Vec2 b = unrotate(pose_.rotationA, pose_.offset + rotate(pose_.rotationB, pair_.b.vertex(remembered_.b)));
        const DVec2 normal = toDouble(closest_.normal);
        closest_.exactPoints.b = toDouble(b) + (-pair_.b.polygon().radius) * normal;
        closest_.exactPoints.a = closest_.exactPoints.b + (-closest_.separation) * normal;
    }

    /// The axis to follow: held where the closest feature says it is held best,
    /// since a face normal turns with its body; by someone else where that gains
    /// little.
    SafeAdvance chooseAxis(double rest) {
        if (inContact_ && !closest_.isApart()) {
            axis_ = remembered_;
            return safeAdvance(pair_, pose_, axis_, level_, rest, reach());
        }
        axis_ = hold(pair_, pose_, closest_, closest_.owner);
        SafeAdvance best = safeAdvance(pair_, pose_, axis_, level_, rest, reach());
        if (best.step >= kGoodStep * rest || (pair_.motion.spinA == 0 && pair_.motion.spinB == 0)) { return best; }
        for (const AxisOwner holder : {AxisOwner::world, AxisOwner::a, AxisOwner::b}) {
            if (holder == closest_.owner) { continue; }
            const HeldAxis other = hold(pair_, pose_, closest_, holder);
            if (other.spin == axis_.spin) { continue; }
            const SafeAdvance advance = safeAdvance(pair_, pose_, other, level_, rest, reach());
            if (advance.step > best.step) {
                best = advance;
                axis_ = other;
            }
        }
        return best;
    }

    VertexReach reach() const { return iterations_ < kPatience ? VertexReach::farthest : VertexReach::own; }

    /// Goes along the closest direction as far as it proves the way free.
    End followAxis() {
        double rest = settings_.tMax - pose_.fraction;
        SafeAdvance advance = chooseAxis(rest);
        double separation = closest_.separation;
        for (int looks = 0;; ++looks) {
            const bool free = advance.step >= rest;  // nothing more can happen, even from within the band
            if (!free && separation <= closeEnough_ && advance.approaches) {
                return looks == 0 ? End::hit : atEndOfAxis();
            }
            const double next = free ? settings_.tMax : pose_.fraction + advance.step;
            if (settings_.observer != nullptr) { tell(next); }
            if (free) { return End::free; }
            if (!(next > pose_.fraction)) { return looks == 0 ? End::stuck : End::newAxis; }
            if (separation > closeEnough_) {
                fractionLower_ = pose_.fraction;
                separationLower_ = separation;
            }
            pair_.moveTo(next, pose_);
            follow(pair_, pose_, advance, axis_);
            ++rootIterations_;
            separation = axis_.gap - pair_.radii;
            if (separation <= target_) { return atEndOfAxis(); }
            if (looks + 1 >= kLooksPerAxis) { return End::newAxis; }
            rest = settings_.tMax - pose_.fraction;
            advance = safeAdvance(pair_, pose_, axis_, level_, rest, reach());
        }
    }

    /// Along the axis the pair touches. Where the axis is the normal of a face
    /// and the other's deepest vertex stands over that face, this is the
    /// distance.
    End atEndOfAxis() {
        if (!closest_.isApart() || closest_.gjk.count < 2 || axis_.holder == AxisOwner::world) { return End::newAxis; }
        const SupportPair& p = closest_.gjk.simplex[0];
        const SupportPair& q = closest_.gjk.simplex[1];
        const bool ofA = axis_.holder == AxisOwner::a;
        // Where the cores cross the line of the face only the distance knows how
        // deep they are in each other.
        if (closest_.owner != axis_.holder || !(axis_.gap > 0)) { return End::newAxis; }
        face_ = ofA ? ToiFeature{p.a, q.a} : ToiFeature{p.b, q.b};
        const CenteredPolygon& reference = ofA ? pair_.a : pair_.b;
        const CenteredPolygon& other = ofA ? pair_.b : pair_.a;
        const Rotation frame = ofA ? pose_.rotationA : pose_.rotationB;
        const Vec2 offset = ofA ? pose_.offset : -pose_.offset;
        const Rotation otherFrame = ofA ? pose_.rotationB : pose_.rotationA;
        const int vertex = ofA ? axis_.b : axis_.a;
        const int deepest = ofA ? axis_.a : axis_.b;
        if (deepest != face_.first && deepest != face_.second) { return End::newAxis; }
        const Vec2 from = reference.vertex(face_.first);
        const Vec2 edge = reference.vertex(face_.second) - from;
        const Vec2 foot = unrotate(frame, offset + rotate(otherFrame, other.vertex(vertex))) - from;
        const double along = dot(edge, foot);
        return along >= 0 && along <= dot(edge, edge) ? End::touching : End::newAxis;
    }

    Toi answerOnFace() const {
        const bool ofA = axis_.holder == AxisOwner::a;
        const DVec2 normal{axis_.normal.x, axis_.normal.y};
        const DVec2 center = centerAt(sweepA_, pose_.fraction);
        const DVec2 offset{pose_.offset.x, pose_.offset.y};
        Toi toi = bare(ToiState::hit);
        toi.separation = axis_.gap - pair_.radii;
        toi.normal = normal;
        if (ofA) {
            const DVec2 b = offset + toWorld(pose_.rotationB, toDouble(pair_.b.vertex(axis_.b)));
            toi.pointB = center + (b + (-pair_.b.polygon().radius) * normal);
            toi.pointA = center + (b + (pair_.a.polygon().radius - axis_.gap) * normal);
            toi.featureA = face_;
            toi.featureB = {axis_.b, -1};
        } else {
            const DVec2 a = toWorld(pose_.rotationA, toDouble(pair_.a.vertex(axis_.a)));
            toi.pointA = center + (a + pair_.a.polygon().radius * normal);
            toi.pointB = center + (a + (axis_.gap - pair_.b.polygon().radius) * normal);
            toi.featureA = {axis_.a, -1};
            toi.featureB = face_;
        }
        return toi;
    }

    Toi separated() {
        if (settings_.detail == ToiDetail::event) {
            pose_.fraction = settings_.tMax;
            Toi toi = bare(ToiState::separated);
            toi.fractionLower = settings_.tMax;
            toi.separationLower = 0;
            return toi;
        }
        if (iterations_ == 0 || pose_.fraction < settings_.tMax) {
            pose_ = pair_.poseAt(settings_.tMax);
            look();
        }
        return answer(ToiState::separated);
    }

    Toi overlapped() {
        if (settings_.detail != ToiDetail::depth) { return bare(ToiState::overlapped); }
        if (closest_.isDeep()) { pair_.measureOverlap(pose_, closest_); }
        return answer(ToiState::overlapped);
    }

    Toi bare(ToiState state) const {
        Toi toi;
        toi.state = state;
        toi.fraction = pose_.fraction;
        toi.target = target_;
        toi.fractionLower = fractionLower_;
        toi.separationLower = separationLower_;
        toi.iterations = iterations_;
        toi.rootIterations = rootIterations_;
        return toi;
    }

    /// The closest features at the present pose.
    Toi answer(ToiState state) const {
        const DVec2 center = centerAt(sweepA_, pose_.fraction);
        const CorePoints witnesses = pair_.witnessesOf(pose_, closest_);
        Toi toi = bare(state);
        toi.separation = closest_.separation;
        toi.normal = toWorld(pose_.rotationA, toDouble(closest_.normal));
        toi.pointA = center + toWorld(pose_.rotationA, witnesses.a);
        toi.pointB = center + toWorld(pose_.rotationA, witnesses.b);
        if (closest_.isApart()) {
            const SupportPair& p = closest_.gjk.simplex[0];
            const SupportPair& q = closest_.gjk.simplex[closest_.gjk.count > 1 ? 1 : 0];
            toi.featureA = featureOf(p.a, q.a);
            toi.featureB = featureOf(p.b, q.b);
        }
        if (state != ToiState::hit || pose_.fraction <= 0) {
            toi.fractionLower = toi.fraction;
            toi.separationLower = toi.separation;
        }
        return toi;
    }

    /// Out of line: the search is shorter without it.
    SWEPT_COLD void tell(double next) const {
        SimplexCache cold;
        Search here(*this);
        here.pair_.findClosest(pose_, cold, here.closest_);
        if (here.closest_.isDeep()) { here.pair_.measureOverlap(pose_, here.closest_); }
        const Toi toi = here.answer(ToiState::separated);
        settings_.observer->onStep({toi.fraction, toi.separation, toi.normal, toi.pointA, toi.pointB, next});
    }

    MovingPair pair_;
    const Sweep& sweepA_;
    const ToiSettings& settings_;
    double tolerance_;
    double target_ = 0;
    double level_ = 0;
    double closeEnough_ = 0;
    bool inContact_ = false;
    PairPose pose_;
    SimplexCache cache_;
    Closest closest_;
    HeldAxis axis_;
    HeldAxis remembered_;  ///< in contact: along which overlap is measured
    ToiFeature face_;
    double fractionLower_ = 0;
    double separationLower_ = 0;
    int iterations_ = 0;
    int rootIterations_ = 0;
};

Sweep withoutRotation(const Sweep& sweep) {
    Sweep result = sweep;
    result.a1 = result.a0;
    return result;
}

}  // namespace

Toi timeOfImpact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings) {
    return Search(a, sweepA, b, sweepB, settings).run();
}

Toi timeOfImpactInContact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                          const ToiSettings& settings, DVec2 axis) {
    return Search(a, sweepA, b, sweepB, settings).runInContact(axis);
}

Toi shapeCast(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
              const ToiSettings& settings) {
    // Without spin the bound along the closest direction is the exact motion:
    // each step is the ray cast of the relative path against the supporting line,
    // as in van den Bergen's GJK ray cast (2004), with parabolas for paths.
    return timeOfImpact(a, withoutRotation(sweepA), b, withoutRotation(sweepB), settings);
}

double certainUntil(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                    const ToiSettings& settings, double fraction, double level) {
    const MovingPair pair(a, sweepA, b, sweepB);
    const PairPose pose = pair.poseAt(fraction);
    SimplexCache cache;
    Closest closest;
    pair.findClosest(pose, cache, closest);
    if (closest.isDeep()) { pair.measureOverlap(pose, closest); }
    return fraction + bestAdvance(pair, pose, closest, level, settings.tMax - fraction);
}

Toi separationAt(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB, double fraction) {
    const ToiSettings settings;
    return Search(a, sweepA, b, sweepB, settings).separationAt(fraction);
}

double separationAlong(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       double fraction, DVec2 normal) {
    const MovingPair pair(a, sweepA, b, sweepB);
    return hold(pair, pair.poseAt(fraction), Vec2{normal.x, normal.y}, AxisOwner::world).gap - pair.radii;
}

}  // namespace swept
