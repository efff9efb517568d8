#include "chain_passage.h"

#include <algorithm>

#include "../state/tolerances.h"
#include "ghosts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

WorldTransform poseNow(const WorldState& world, std::uint32_t body) { return world.motions[body].pose; }
/// At the start of the last step. (Of what is not awake the present one: it did not move.)
WorldTransform poseBefore(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    return body.awake ? poseOf(body.startCenter, body.startAngle, body.localCenter) : poseNow(world, slot);
}

bool isBehind(const WorldState& world, const Contact& contact, const WorldTransform& ofChain,
              const WorldTransform& ofShape) {
    const Vec2 middle = middleOf(world.shapes[contact.shapeB].polygon);
    return isBehind(world.shapes[contact.shapeA], applyInverse(ofChain, apply(ofShape, middle)));
}

/// What is in the frame of one body, in that of another one.
Vec2 middleIn(const WorldState& world, Vec2 middle, std::uint32_t from, std::uint32_t to) {
    return from == to ? middle : applyInverse(poseNow(world, to), apply(poseNow(world, from), middle));
}

/// What a body does on the other segments of a chain.
struct OnChain {
    bool stands = false;
    bool passes = false;
    bool passesBeside = false;  ///< a segment that hangs together with the one in question
};

/// The contacts with chains among others: sorted by their bodies when one is asked for the first time, since mostly
/// none is.
class ChainContacts {
public:
    /// @param renewed  indices
    ChainContacts(std::span<const Contact> all, std::span<const std::uint32_t> renewed,
                  std::vector<std::uint64_t>& byBody)
        : all_(all), renewed_(renewed), byBody_(byBody) {}

    /// Calls `visit(contact)` for each of a body that is no chain.
    template <class Visit>
    void visitThoseOf(std::uint32_t body, const Visit& visit) {
        if (!areSorted_) { sort(); }
        const std::uint64_t first = std::uint64_t{body} << kBodyShift;
        for (auto i = std::lower_bound(byBody_.begin(), byBody_.end(), first);
             i != byBody_.end() && *i >> kBodyShift == body; ++i) {
            visit(all_[static_cast<std::uint32_t>(*i)]);
        }
    }

private:
    static constexpr int kBodyShift = 32;  ///< above the index of the contact

    void sort() {
        areSorted_ = true;
        byBody_.clear();
        for (const std::uint32_t i : renewed_) {
            if (all_[i].ofChain) { byBody_.push_back(std::uint64_t{all_[i].bodyB} << kBodyShift | i); }
        }
        std::sort(byBody_.begin(), byBody_.end());
    }

    std::span<const Contact> all_;
    std::span<const std::uint32_t> renewed_;
    std::vector<std::uint64_t>& byBody_;
    bool areSorted_ = false;
};

/// Whether a chain that ends with one segment goes on as another one that begins with the other.
bool goesOnAs(const WorldState& world, const Shape& last, const Shape& first) {
    if (!last.segment.hasAfter || !first.segment.hasBefore || !canBeJoined(world, last, first)) { return false; }
    const Real near = kTargetRatio * std::min(last.extent, first.extent);
    const auto areSame = [&](Vec2 ofLast, Vec2 ofFirst) {
        const DVec2 gap = apply(poseNow(world, last.body), ofLast) - apply(poseNow(world, first.body), ofFirst);
        return length(toReal(gap)) <= near;
    };
    const ChainSegment& one = last.segment;
    const ChainSegment& other = first.segment;
    return areSame(one.q, other.p) && areSame(one.after, other.q) && areSame(one.p, other.before);
}

/// Whether chains lead from one segment to another without a corner that is farther away than that, by no more than two
/// of them.
/// @param middle  in the frame of the first one
bool leads(const WorldState& world, std::uint32_t from, std::uint32_t to, Vec2 middle, Real reach) {
    std::uint32_t at = from;
    while (at != to) {
        const Shape& shape = world.shapes[at];
        if (!shape.segment.hasAfter || length(shape.segment.q - middle) > reach) { return false; }
        if (shape.nextInChain != kNoIndex) {
            at = shape.nextInChain;
        } else {
            const Shape& next = world.shapes[world.shapes[to].head];
            if (!goesOnAs(world, shape, next)) { return false; }
            middle = middleIn(world, middle, shape.body, next.body);
            at = world.shapes[to].head;
        }
        if (at == from) { return false; }
    }
    return true;
}

OnChain othersOf(const WorldState& world, const Contact& contact, ChainContacts& contacts) {
    const std::uint32_t head = world.shapes[contact.shapeA].head;
    const Shape& own = world.shapes[contact.shapeB];
    const Vec2 middle =
        applyInverse(poseNow(world, contact.bodyA), apply(poseNow(world, contact.bodyB), middleOf(own.polygon)));
    OnChain others;
    contacts.visitThoseOf(contact.bodyB, [&](const Contact& other) {
        if (!other.touching && !other.passes) { return; }
        const bool isBeside = hangTogether(world, own, middle, contact.shapeA, other.shapeA);
        if (!isBeside && world.shapes[other.shapeA].head != head) { return; }
        others.stands = others.stands || (other.touching && isBeside);
        others.passes = others.passes || other.passes;
        others.passesBeside = others.passesBeside || (other.passes && isBeside);
    });
    return others;
}

/// Beyond an inner corner, what is behind the neighbour there is behind the chain, though in front of this side of it.
bool isBeyondInnerCorner(const ChainSegment& segment, Vec2 place) {
    const Vec2 edge = segment.q - segment.p;
    const Vec2 before = segment.p - segment.before;
    const Vec2 after = segment.after - segment.q;
    const bool isFirst = segment.hasBefore && cross(before, edge) < 0 && dot(place - segment.p, edge) < 0;
    const bool isLast = segment.hasAfter && cross(edge, after) < 0 && dot(place - segment.q, edge) > 0;
    return (isFirst && cross(before, place - segment.p) > 0) || (isLast && cross(after, place - segment.q) > 0);
}

/// Beyond an outer corner, what is in front of the neighbour there is in front of the chain, though behind this side.
bool isBeyondOuterCorner(const ChainSegment& segment, Vec2 place) {
    const Vec2 edge = segment.q - segment.p;
    const Vec2 before = segment.p - segment.before;
    const Vec2 after = segment.after - segment.q;
    const bool isFirst = segment.hasBefore && cross(before, edge) > 0 && dot(place - segment.p, edge) < 0;
    const bool isLast = segment.hasAfter && cross(edge, after) > 0 && dot(place - segment.q, edge) > 0;
    return (isFirst && cross(before, place - segment.p) < 0) || (isLast && cross(after, place - segment.q) < 0);
}

/// @param ofChain, ofShape  now, or as the last step began
bool arrivesFromBehind(const WorldState& world, const Contact& contact, const WorldTransform& ofChain,
                       const WorldTransform& ofShape) {
    const Shape& segment = world.shapes[contact.shapeA];
    const Shape& own = world.shapes[contact.shapeB];
    const DVec2 middle = apply(ofShape, middleOf(own.polygon));
    const auto velocityOf = [&](std::uint32_t body, const WorldTransform& pose) {
        const BodyMotion& motion = world.motions[body];
        const DVec2 center = apply(pose, world.bodies[body].localCenter);
        return motion.velocity + cross(motion.angularVelocity, toReal(middle - center));
    };
    return comesAlong({.height = heightOver(segment, ofChain, own, ofShape),
                       .normal = rotate(ofChain.rotation, segment.polygon.normals[0]),
                       .velocity = velocityOf(contact.bodyB, ofShape) - velocityOf(contact.bodyA, ofChain),
                       .extent = contact.extent});
}

/// Whether the middle of the shape was behind as the last step began.
bool wasBehindBefore(const WorldState& world, const Contact& contact) {
    const Shape& segment = world.shapes[contact.shapeA];
    const Shape& own = world.shapes[contact.shapeB];
    const WorldTransform ofChain = poseBefore(world, contact.bodyA);
    const WorldTransform ofShape = poseBefore(world, contact.bodyB);
    const Vec2 place = applyInverse(ofChain, apply(ofShape, middleOf(own.polygon)));
    if (isBehind(segment, place)) { return !isBeyondOuterCorner(segment.segment, place); }
    return isBeyondInnerCorner(segment.segment, place) && arrivesFromBehind(world, contact, ofChain, ofShape);
}

bool isPastStanding(const Contact& contact) {
    return deepestSeparation(contact.manifold) < -kPassedRatio * contact.extent;
}

/// @pre it has points
bool comesThrough(const WorldState& world, const Contact& contact, Moment moment, ChainContacts& contacts) {
    // A contact that is new was put there, and what was put into the ground comes out of it.
    if (contact.touching || moment != Moment::stepBegins || !contact.wasSeen || !isPastStanding(contact)) {
        return false;
    }
    return wasBehindBefore(world, contact) && !othersOf(world, contact, contacts).stands;  // or it goes over a corner
}

/// Whether it gets to the next segment while it passes one.
/// @pre it has points
bool comesFromBeside(const WorldState& world, const Contact& contact, ChainContacts& contacts) {
    if (contact.touching) { return false; }
    if (!arrivesFromBehind(world, contact, poseNow(world, contact.bodyA), poseNow(world, contact.bodyB))) {
        return false;
    }
    const OnChain others = othersOf(world, contact, contacts);
    return !others.stands && (others.passesBeside || (others.passes && isPastStanding(contact)));
}

/// Of one that came through: whether it is neither out of the chain nor behind it again.
bool isStillInside(const WorldState& world, const Contact& contact) {
    const WorldTransform ofChain = poseNow(world, contact.bodyA);
    const WorldTransform ofShape = poseNow(world, contact.bodyB);
    const Real height = heightOver(world.shapes[contact.shapeA], ofChain, world.shapes[contact.shapeB], ofShape);
    return height < -kTargetRatio * contact.extent && !isBehind(world, contact, ofChain, ofShape);
}

void takePoints(Contact& contact) {
    contact.manifold = {};
    contact.isKept = false;
    contact.normalImpulse = contact.tangentImpulse = {};
}

}  // namespace

Vec2 middleOf(const Polygon& core) {
    Vec2 sum;
    for (const Vec2 vertex : core.points()) { sum += vertex; }
    return (1 / static_cast<Real>(core.count)) * sum;
}

bool canBeJoined(const WorldState& world, const Shape& a, const Shape& b) {
    const auto isFixed = [&world](const Shape& shape) { return world.bodies[shape.body].def.type == BodyType::fixed; };
    return a.body == b.body || (isFixed(a) && isFixed(b));
}

Real heightOver(const Shape& segment, const WorldTransform& ofChain, const Shape& own, const WorldTransform& ofShape) {
    const Vec2 normal = rotate(ofChain.rotation, segment.polygon.normals[0]);
    return separationAlong(segment.polygon, ofChain, own.polygon, ofShape, normal);
}

bool comesAlong(const ChainArrival& arrival) {
    constexpr Real kNoise = Real(1) / 16;
    // What rises, and not only by noise, is nearly out, and stands on nothing.
    const bool rises = dot(arrival.velocity, arrival.normal) > kNoise * length(arrival.velocity);
    if (rises) { return arrival.height < -kTargetRatio * arrival.extent; }
    constexpr Real kOnTop = 1 - 2 * kPassedRatio;  // of a circle that is as deep as that
    return arrival.height < -kPassedRatio * arrival.extent && dot(arrival.towards, arrival.normal) < kOnTop;
}

bool hangTogether(const WorldState& world, const Shape& own, Vec2 middle, std::uint32_t a, std::uint32_t b) {
    Real reach = 0;
    const Vec2 center = middleOf(own.polygon);
    for (const Vec2 vertex : own.polygon.points()) { reach = std::max(reach, length(vertex - center)); }
    constexpr Real kRoom = 2;  // it may have moved since it stood there
    reach = kRoom * (reach + own.polygon.radius + world.shapes[a].segment.radius);
    const std::uint32_t bodyA = world.shapes[a].body;
    const std::uint32_t bodyB = world.shapes[b].body;
    return leads(world, a, b, middle, reach) || leads(world, b, a, middleIn(world, middle, bodyA, bodyB), reach);
}

bool letThrough(const WorldState& world, std::span<Contact> contacts, std::span<const std::uint32_t> renewed,
                Moment moment, std::span<const ChainPasser> crossing, std::vector<std::uint64_t>& byBody) {
    ChainContacts ofChains(contacts, renewed, byBody);
    bool any = false;
    for (const std::uint32_t i : renewed) {
        Contact& contact = contacts[i];
        if (!contact.ofChain) { continue; }
        const ChainPasser passer{.segment = contact.shapeA, .shape = contact.shapeB};
        // It may have no points, where another piece of the chain has them: for sweeps it is in the way all the same.
        const bool isIn =
            contact.passes || (!contact.touching && std::binary_search(crossing.begin(), crossing.end(), passer));
        contact.passes = (isIn && isStillInside(world, contact)) || (!contact.passes && contact.manifold.count > 0 &&
                                                                     comesThrough(world, contact, moment, ofChains));
        contact.wasSeen = true;
        if (contact.passes) { takePoints(contact); }
        any = any || contact.passes;
    }
    if (!any) { return false; }
    for (const std::uint32_t i : renewed) {
        Contact& contact = contacts[i];
        if (!contact.ofChain || contact.passes || contact.manifold.count == 0) { continue; }
        contact.passes = comesFromBeside(world, contact, ofChains);
        if (contact.passes) { takePoints(contact); }
    }
    return any;
}

void letThrough(WorldState& world) {
    world.chainPassers.clear();
    const bool any =
        letThrough(world, world.contacts, world.lists.ground, Moment::stepBegins, world.crossed, world.chainContacts);
    world.crossed.clear();
    if (!any) { return; }
    for (const std::uint32_t i : world.lists.ground) {
        const Contact& contact = world.contacts[i];
        if (contact.passes) { world.chainPassers.push_back({contact.shapeA, contact.shapeB}); }
    }
    std::sort(world.chainPassers.begin(), world.chainPassers.end());
}

bool passesChain(const WorldState& world, std::uint32_t shape, std::uint32_t segment) {
    const ChainPasser asked{.segment = segment, .shape = shape};
    return std::binary_search(world.chainPassers.begin(), world.chainPassers.end(), asked);
}

}  // namespace swept::inline SWEPT_PRECISION
