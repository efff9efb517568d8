#include "hits.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <swept/shapes/distance.h>
#include <swept/toi/time_of_impact.h>
#include <swept/toi/toi_polygon.h>

#include "posed_scene.h"

namespace swept::measures {
namespace {

/// The rest of a speed that is a part of a response: even a bar hit at its end changes its centre's speed by a quarter
/// of the approach; a part of that leaves room for what else acts.
constexpr double kResponse = 1.0 / 16;
/// Part of its speed with which a body approaches, at least: less is grazing, and rounding decides.
constexpr double kHeadOn = 1.0 / 16;
/// Nearer than this part of the smaller extent is as good as touching (four times the engine's own target).
constexpr double kTouch = 1.0 / 256;

/// A body through a sample if nothing acts on it but gravity.
struct Flight {
    Sweep sweep;
    DVec2 velocity;      ///< at the start
    DVec2 acceleration;  ///< m/s²
    double time = 0;     ///< of the sample, s

    DVec2 velocityAt(double fraction) const { return velocity + (fraction * time) * acceleration; }
};

Flight flightOf(const PosedScene& posed, int body, const BodyFrame& frame, double time) {
    const PlacedScene& placed = posed.placed();
    const PlacedBody& where = placed.bodies[static_cast<std::size_t>(body)];
    Flight flight;
    flight.velocity = frame.velocity;
    flight.time = time;
    if (where.isDynamic()) { flight.acceleration = where.description->gravityScale * placed.scene->gravity; }
    flight.sweep.localCenter = posed.localCenter(body);
    flight.sweep.c0 = where.center;
    flight.sweep.c1 = where.center + time * frame.velocity + (0.5 * time * time) * flight.acceleration;
    flight.sweep.k = (0.5 * time * time) * flight.acceleration;
    flight.sweep.a0 = frame.angle;
    flight.sweep.a1 = frame.angle + time * frame.angularVelocity;
    return flight;
}

/// What a flight may reach: the circle about its centre, carried along.
Aabb reachOf(const Flight& flight, double radius) {
    const Sweep& s = flight.sweep;
    const DVec2 reach{radius + std::fabs(s.k.x), radius + std::fabs(s.k.y)};
    const DVec2 lower{std::min(s.c0.x, s.c1.x), std::min(s.c0.y, s.c1.y)};
    const DVec2 upper{std::max(s.c0.x, s.c1.x), std::max(s.c0.y, s.c1.y)};
    return roundedOutward(lower - reach, upper + reach);
}

double separationOf(const PlacedScene& placed, const PlacedPiece& a, const PlacedPiece& b) {
    return distance(a.polygon, b.polygon, relativeTransform(bodyOf(placed, a).pose, bodyOf(placed, b).pose)).distance;
}

/// How far a shape reaches along a direction from a point, metres.
double reachAlong(const PlacedScene& placed, const PlacedPiece& piece, DVec2 from, DVec2 direction) {
    double farthest = 0;
    for (const Vec2 vertex : piece.polygon.points()) {
        farthest = std::max(farthest, dot(apply(bodyOf(placed, piece).pose, vertex) - from, direction));
    }
    return farthest + piece.polygon.radius;
}

/// The first impact of a body within a sample.
struct Impact {
    const PlacedPiece* piece = nullptr;
    const PlacedPiece* obstacle = nullptr;
    Toi toi;
    DVec2 obstacleVelocity;
    double approach = 0;   ///< m/s of the centres, along the normal
    bool matters = false;  ///< enough to judge what became of it
};

class Foresight {
public:
    Foresight(const SceneDescription& scene, const Recording& recording)
        : scene_(scene),
          recording_(recording),
          posed_(scene),
          isTied_(scene.bodies.size(), false),
          movers_(scene.bodies.size()) {
        for (const JointDescription& joint : scene.joints) {
            for (const std::string& name : {joint.bodyA, joint.bodyB}) {
                if (const int body = bodyNamed(posed_.placed(), name); body >= 0) {
                    isTied_[static_cast<std::size_t>(body)] = true;
                }
            }
        }
        for (const PlacedPiece& piece : posed_.placed().pieces) {
            const PlacedBody& body = bodyOf(posed_.placed(), piece);
            const bool isSensor = body.description->shapes[static_cast<std::size_t>(piece.shape)].sensor;
            if (!isSensor) {
                (body.isDynamic() ? movers_[static_cast<std::size_t>(body.index)] : obstacles_).push_back(&piece);
            }
        }
    }

    std::vector<ForeseenHit> all() {
        std::vector<ForeseenHit> hits;
        for (std::size_t i = 0; i + 1 < recording_.samples.size(); ++i) {
            lookAt(recording_.samples[i], recording_.samples[i + 1], hits);
        }
        return hits;
    }

private:
    void lookAt(const Sample& sample, const Sample& next, std::vector<ForeseenHit>& hits) {
        posed_.pose(sample);
        std::vector<std::pair<int, Impact>> impacts;
        const double time = next.time - sample.time;
        for (const PlacedBody& body : posed_.placed().bodies) {
            const bool isFree = body.isDynamic() && !isTied_[static_cast<std::size_t>(body.index)];
            if (!isFree) { continue; }
            if (const auto impact = firstImpact(body, sample, time)) { impacts.emplace_back(body.index, *impact); }
        }
        if (impacts.empty()) { return; }
        posed_.pose(next);
        for (const auto& [body, impact] : impacts) { hits.push_back(judged(body, impact, sample, next)); }
    }

    /// Nothing when the flight meets nothing, or is none: something touches the body already.
    std::optional<Impact> firstImpact(const PlacedBody& body, const Sample& sample, double time) const {
        const PlacedScene& placed = posed_.placed();
        const Flight flight = flightOf(posed_, body.index, sample.bodies[static_cast<std::size_t>(body.index)], time);
        const Aabb reach = reachOf(flight, body.reach);
        std::optional<Impact> first;
        for (const PlacedPiece* const obstacle : obstacles_) {
            const PlacedBody& other = bodyOf(placed, *obstacle);
            const BodyFrame& frame = sample.bodies[static_cast<std::size_t>(other.index)];
            const Flight otherFlight = flightOf(posed_, other.index, frame, time);
            const bool moves = other.description->type == SceneBodyType::kinematic;
            if (!overlaps(reach, moves ? reachOf(otherFlight, other.reach) : obstacle->bounds)) { continue; }
            for (const PlacedPiece* const piece : movers_[static_cast<std::size_t>(body.index)]) {
                if (!mayCollide(placed, *piece, *obstacle) || isBehindChain(placed, *obstacle, *piece)) { continue; }
                if (separationOf(placed, *piece, *obstacle) <= kTouch * std::min(piece->extent, obstacle->extent)) {
                    return std::nullopt;
                }
                const auto impact = impactOf(*piece, flight, *obstacle, otherFlight);
                if (impact && (!first || impact->toi.fraction < first->toi.fraction)) { first = impact; }
            }
        }
        return first;
    }

    /// Nothing when they do not meet, or when it does not matter.
    static std::optional<Impact> impactOf(const PlacedPiece& piece, const Flight& flight, const PlacedPiece& obstacle,
                                          const Flight& otherFlight) {
        const ToiPolygon a = asToiPolygon(piece.polygon);
        const ToiPolygon b = asToiPolygon(obstacle.polygon);
        const Toi toi = timeOfImpact(a, flight.sweep, b, otherFlight.sweep, defaultToiSettings(a, b));
        if (toi.state != ToiState::hit) { return std::nullopt; }
        const DVec2 relative = flight.velocityAt(toi.fraction) - otherFlight.velocity;
        const double approach = dot(relative, toi.normal);
        const double gained = length(flight.acceleration) * flight.time;
        const double depth = approach * (1 - toi.fraction) * flight.time;
        const bool matters = approach > gained && approach > kHeadOn * length(relative) &&
                             depth > kTouch * std::min(piece.extent, obstacle.extent);
        return Impact{&piece, &obstacle, toi, otherFlight.velocity, approach, matters};
    }

    /// With the scene posed at the end of the sample.
    ForeseenHit judged(int body, const Impact& impact, const Sample& sample, const Sample& next) const {
        const PlacedScene& placed = posed_.placed();
        const double time = next.time - sample.time;
        const double wait = (1 - impact.toi.fraction) * time;
        const PlacedBody& mover = placed.bodies[static_cast<std::size_t>(body)];
        const DVec2 free = sample.bodies[static_cast<std::size_t>(body)].velocity +
                           (time * mover.description->gravityScale) * scene_.gravity;
        const DVec2 change = free - next.bodies[static_cast<std::size_t>(body)].velocity;
        const bool responded = dot(change, impact.toi.normal) > kResponse * impact.approach;
        const double separation = separationOf(placed, *impact.piece, *impact.obstacle);
        const double extent = std::min(impact.piece->extent, impact.obstacle->extent);
        const DVec2 witness = impact.toi.pointB + wait * impact.obstacleVelocity;
        const double depth = dot(mover.center - witness, impact.toi.normal);
        const bool passed = depth > 0.5 * reachAlong(placed, *impact.obstacle, witness, impact.toi.normal);
        ForeseenHit hit{body, impact.obstacle->body, sample.time + impact.toi.fraction * time, wait, false, false};
        if (!impact.matters) { return hit; }
        hit.missed = (!responded && separation > kTouch * extent) || (passed && separation <= 0);
        hit.late = !hit.missed && !responded;
        return hit;
    }

    const SceneDescription& scene_;
    const Recording& recording_;
    PosedScene posed_;
    std::vector<bool> isTied_;
    std::vector<std::vector<const PlacedPiece*>> movers_;  ///< of each body that is dynamic
    std::vector<const PlacedPiece*> obstacles_;
};

}  // namespace

std::vector<ForeseenHit> foreseenHits(const SceneDescription& scene, const Recording& recording) {
    return Foresight(scene, recording).all();
}

}  // namespace swept::measures
