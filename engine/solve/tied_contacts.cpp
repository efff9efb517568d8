#include "tied_contacts.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include "../../shapes/branchless.h"
#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../../solver/contacts/contact_lanes.h"
#include "../bodies/travel.h"
#include "../contacts/contact_making.h"
#include "../crew/join_blocks.h"
#include "../modes/modes.h"
#include "../state/profile.h"
#include "../state/tolerances.h"
#include "blow_answer.h"
#include "step_change.h"
#include "strained_bodies.h"
#include "turning_lanes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts that are fetched from memory ahead of time: before a solve, and after it, which has displaced
/// them.
constexpr std::size_t kAhead = 8;
/// Pairs per block that one worker links.
constexpr std::size_t kPairsPerBlock = 512;

void fetchRow(const Contact& contact) {
    constexpr std::size_t kLine = 64;
    const char* const first = reinterpret_cast<const char*>(&contact);
    for (std::size_t i = 0; i < sizeof(ContactRow); i += kLine) { prefetch(first + i); }
}

void fetchOutcome(const Contact& contact) {
    prefetch(&contact.normalImpulse);
    prefetch(&contact.pressed);
}

/// For `SolverSettings::settled`: what presses holds where it is, what is apart is not in the way.
void holdAsItIs(ContactConstraintPoint& point) {
    point.separation = point.normalImpulse > 0 ? Real(0) : point.baseSeparation;
}

}  // namespace

TiedContacts::TiedContacts(WorldState& world, const TiedGroup& group, const StepPart& part, Real h, Real scale)
    : world_(world),
      group_(group),
      hits_(world, part, group.desk.events),
      scale_(scale),
      dt_(static_cast<Real>(part.dt)),
      closingTime_(static_cast<Real>(world.closingTime)),
      softness_(softnessOfStep(world, group.effort, kContactCycles, kContactDampingRatio, h, dt_)),
      groundSoftness_(
          softnessOfStep(world, group.effort, groundCyclesOf(world.settings), kContactDampingRatio, h, dt_)) {}

/// As the kernels of rows have it, and `softenStrained`.
Softness TiedContacts::softnessOf(const ContactLink& link) const {
    const auto& inertias = group_.desk.batch.inertias;
    const bool isOnGround = inertias[link.slotA].inverseMass == 0 || inertias[link.slotB].inverseMass == 0;
    return isOnGround && !areStrained(group_.desk, link.slotA, link.slotB) ? groundSoftness_ : softness_;
}

template <std::size_t kPoints>
void TiedContacts::softenStrained(WideContact<kPoints>& block, Links links) const {
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        if (areStrained(group_.desk, links[lane].slotA, links[lane].slotB)) { setSoftness(block, lane, softness_); }
    }
}

/// In place: what is written in pieces and copied has to wait for the pieces.
SWEPT_FORCE_INLINE bool TiedContacts::linkIfTied(ContactLink& link, std::uint32_t source, std::uint32_t bodyA,
                                                 std::uint32_t bodyB, const TouchTraits& traits) const {
    const BodySlot slotA = world_.solverSlots[bodyA];
    const BodySlot slotB = world_.solverSlots[bodyB];
    link.slotA = slotA;
    link.slotB = slotB;
    link.source = source;
    link.points = traits.points;
    link.isAlone = (int{traits.isBelt} | int{traits.rolls()}) != 0;  // blocks know neither
    link.bounces = traits.bounces;
    // Kinematic bodies have slots, too.
    return ((slotA & maskOf<BodySlot>(traits.dynamicA)) | (slotB & maskOf<BodySlot>(traits.dynamicB))) != kFixedSlot;
}

/// Of all contacts with points of which the group moves a body, in their order.
template <class Visit>
void TiedContacts::forEachLink(const Visit& visit) const {
    ContactLink link;
    if (group_.role == BodyRole::solved) {
        for (const TouchingPair& pair : group_.touching) {
            if (linkIfTied(link, pair.contact, pair.bodyA, pair.bodyB, pair)) { visit(link); }
        }
        return;
    }
    for (std::uint32_t i = 0; i < group_.contacts.size(); ++i) {
        const Contact& contact = group_.contacts[i];
        if (!contact.isSolid()) { continue; }
        const TouchTraits traits{.points = static_cast<std::uint8_t>(contact.manifold.count),
                                 .dynamicA = contact.dynamicA,
                                 .dynamicB = contact.dynamicB,
                                 .bounces = contact.restitution > 0,
                                 .isBelt = contact.isBelt,
                                 .resistsRolling = contact.resistsRolling};
        if (linkIfTied(link, i, contact.bodyA, contact.bodyB, traits)) { visit(link); }
    }
}

ContactFrame TiedContacts::frameOf(const Contact& contact, const ContactLink& link) const {
    const ContactFrame frame = contactFrameOf(world_.motions[contact.bodyA], world_.bodies[contact.bodyA].localCenter,
                                              world_.motions[contact.bodyB]);
    return anyTurns(group_.desk, link.slotA, link.slotB)
               ? turned(frame, groundTurnOf(group_.desk, link.slotA, link.slotB))
               : frame;
}

ContactConstraint TiedContacts::constraintFor(const ContactLink& link) {
    const Contact& contact = group_.contacts[link.source];
    ContactConstraint constraint = constraintOf(contact.manifold, frameOf(contact, link), surfaceOf(world_, contact),
                                                pushRatioOf(world_.settings) * contact.extent / closingTime_);
    constraint.slotA = link.slotA;
    constraint.slotB = link.slotB;
    constraint.softness = softnessOf(link);
    constraint.radiusA = contact.radiusA;
    constraint.radiusB = contact.radiusB;
    if (anyTurns(group_.desk, link.slotA, link.slotB)) { setTurningRadii(world_, group_, link, constraint); }
    constraint.source = link.source;
    constraint.bounceSpeed = bounceSpeedOf(contact);
    for (std::size_t k = 0; k < link.points; ++k) {
        constraint.points[k].normalImpulse = scale_ * contact.normalImpulse[k];
        constraint.points[k].tangentImpulse = scale_ * contact.tangentImpulse[k];
        if (group_.effort.isSettled) { holdAsItIs(constraint.points[k]); }
    }
    if (constraint.restitution > 0) { setAnswers(world_, contact, constraint); }
    if (contact.rolls()) { constraint.rollingImpulse = scale_ * contact.rollingImpulse(); }
    return constraint;
}

/// Where the bodies are, and what else is not in the row of the contact.
template <std::size_t kPoints>
void TiedContacts::setLane(WideContact<kPoints>& block, std::size_t lane, const ContactLink& link,
                           ContactSources& from) const {
    const Contact& contact = group_.contacts[link.source];
    const BodyInertia& inertiaA = group_.desk.batch.inertias[link.slotA];
    const BodyInertia& inertiaB = group_.desk.batch.inertias[link.slotB];
    const BodyMotion& a = world_.motions[contact.bodyA];
    // Of the bodies of a solve it stands in an array of their own; what does not move in it is most often one and the
    // same.
    const Vec2 localCenterA =
        link.slotA != kFixedSlot ? group_.desk.localCenters[link.slotA] : world_.bodies[contact.bodyA].localCenter;
    const Vec2 fromAToB = toReal(world_.motions[contact.bodyB].center - a.center);
    block.stateA[lane] = offsetOf(link.slotA);
    block.stateB[lane] = offsetOf(link.slotB);
    block.inverseMassA[lane] = inertiaA.inverseMass;
    block.inverseMassB[lane] = inertiaB.inverseMass;
    block.inverseInertiaA[lane] = inertiaA.inverseInertia;
    block.inverseInertiaB[lane] = inertiaB.inverseInertia;
    from.rotationC[lane] = a.pose.rotation.c;
    from.rotationS[lane] = a.pose.rotation.s;
    from.localCenterX[lane] = localCenterA.x;
    from.localCenterY[lane] = localCenterA.y;
    from.fromAToBX[lane] = fromAToB.x;
    from.fromAToBY[lane] = fromAToB.y;
    from.extent[lane] = contact.extent;
    from.rows[lane] = &contact;
}

/// The same as `constraintFor` makes, without making one.
template <std::size_t kPoints>
void TiedContacts::fillBlocks(std::span<WideContact<kPoints>> blocks, Links links) {
    static constexpr ContactRow kNothing{};
    const ContactTerms terms{.scale = scale_,
                             .pushRatio = pushRatioOf(world_.settings),
                             .closingTime = closingTime_,
                             .bounceSpeed = bounceSpeed_,
                             .softness = softness_,
                             .groundSoftness = groundSoftness_,
                             .settled = group_.effort.isSettled};
    ContactSources from;
    for (WideContact<kPoints>& block : blocks) {
        if (block.lanes < kBlockLanes) {
            from = {};
            from.rows.fill(&kNothing);
        }
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            if (lane + kAhead < links.size()) { fetchRow(group_.contacts[links[lane + kAhead].source]); }
            setLane(block, lane, links[lane], from);
        }
        const std::uint32_t turning = lanesOnTurning(group_.desk, block, links);
        turnLanes(turning, group_.desk, links, from);
        if constexpr (kPoints == 2) {
            contactRowKernels()->fillTwo(block, from, terms);
        } else {
            contactRowKernels()->fillOne(block, from, terms);
        }
        setTurningRadii(turning, world_, group_, links, block);
        if (!group_.desk.grounds.empty()) { softenStrained(block, links); }
        links = links.subspan(kBlockLanes);
    }
}

Real TiedContacts::bounceSpeedOf(const Contact& contact) const {
    return contact.restitution > kLivelyRestitution ? bounceSpeed_ : std::numeric_limits<Real>::infinity();
}

std::size_t TiedContacts::countBouncing() const {
    std::size_t count = 0;
    forEachLink([&count](const ContactLink& link) { count += link.bounces ? 1 : 0; });
    return count;
}

/// Each is written down, and kept if it is tied.
LinkCounts TiedContacts::linkSome(std::span<const TouchingPair> pairs, ContactLink* to) const {
    LinkCounts counts;
    for (const TouchingPair& pair : pairs) {
        ContactLink& link = to[counts.links];
        const bool isTied = linkIfTied(link, pair.contact, pair.bodyA, pair.bodyB, pair);
        counts.links += isTied ? 1 : 0;
        counts.bouncing += (int{isTied} & int{link.bounces}) != 0 ? 1 : 0;
    }
    return counts;
}

/// Any worker links the pairs of a block, at the place that they have if all before them are linked, as mostly.
std::size_t TiedContacts::link() {
    SolverBatch& batch = group_.desk.batch;
    batch.store = this;
    std::size_t bouncing = 0;
    if (group_.role != BodyRole::solved) {
        forEachLink([&batch, &bouncing](const ContactLink& link) {
            batch.links.push_back(link);
            bouncing += link.bounces ? 1 : 0;
        });
        return bouncing;
    }
    const std::span<const TouchingPair> pairs = group_.touching;
    batch.links.resize(pairs.size());
    std::vector<LinkCounts>& counts = group_.desk.linkCounts;
    counts.resize((pairs.size() + kPairsPerBlock - 1) / kPairsPerBlock);
    group_.desk.loops->run(counts.size(), 1, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t block = first; block < last; ++block) {
            const std::size_t begin = block * kPairsPerBlock;
            const std::size_t length = std::min(kPairsPerBlock, pairs.size() - begin);
            counts[block] = linkSome(pairs.subspan(begin, length), &batch.links[begin]);
        }
    });
    joinBlocks(batch.links, counts.size(), kPairsPerBlock,
               [&counts](std::size_t block) { return counts[block].links; });
    for (const LinkCounts& some : counts) { bouncing += some.bouncing; }
    return bouncing;
}

void TiedContacts::letBounce(bool inTurn) {
    if (inTurn) {
        bounceSpeed_ = hits_.threshold();
    } else {
        for (ContactLink& link : group_.desk.batch.links) { link.isAlone = link.isAlone || link.bounces; }
    }
}

void TiedContacts::unlink() {
    group_.desk.batch.links.clear();
    group_.desk.batch.store = nullptr;
}

void TiedContacts::addConstraints() {
    SolverBatch& batch = group_.desk.batch;
    forEachLink([&](const ContactLink& link) { batch.contacts.push_back(constraintFor(link)); });
    if (world_.watched) { anchorAhead(); }
}

/// What was made ahead is held by its cores (mode `speculative`).
void TiedContacts::anchorAhead() {
    for (ContactConstraint& constraint : group_.desk.batch.contacts) {
        const Contact& contact = group_.contacts[constraint.source];
        if (!isAhead(world_, contact)) { continue; }
        anchorAtCores(constraint, contact.radiusA, contact.radiusB);
    }
}

void TiedContacts::readConstraints() {
    for (const ContactConstraint& constraint : group_.desk.batch.contacts) { takeConstraint(constraint); }
}

std::size_t TiedContacts::count() const {
    return group_.desk.batch.store != nullptr ? group_.desk.batch.links.size() : group_.desk.batch.contacts.size();
}

void TiedContacts::fill(std::span<WideContact<1>> blocks, Links links) { fillBlocks(blocks, links); }
void TiedContacts::fill(std::span<WideContact<2>> blocks, Links links) { fillBlocks(blocks, links); }
void TiedContacts::fill(std::span<ContactConstraint> alone, Links links) {
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (i + kAhead < links.size()) { fetchRow(group_.contacts[links[i + kAhead].source]); }
        alone[i] = constraintFor(links[i]);
    }
}

void TiedContacts::take(std::span<const WideContact<1>> blocks, Links links) { takeBlocks(blocks, links); }
void TiedContacts::take(std::span<const WideContact<2>> blocks, Links links) { takeBlocks(blocks, links); }
void TiedContacts::take(std::span<const ContactConstraint> alone, Links) {
    for (const ContactConstraint& constraint : alone) { takeConstraint(constraint); }
}

template <std::size_t kPoints>
void TiedContacts::takeBlocks(std::span<const WideContact<kPoints>> blocks, Links links) {
    std::array<ContactRow*, kBlockLanes> rows;
    for (const WideContact<kPoints>& block : blocks) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            if (lane + kAhead < links.size()) { fetchOutcome(group_.contacts[links[lane + kAhead].source]); }
            rows[lane] = &group_.contacts[links[lane].source];
        }
        const std::span<ContactRow* const> inUse = std::span(rows).first(block.lanes);
        LanesByPoint pressing;
        if constexpr (kPoints == 2) {
            pressing = contactRowKernels()->takeTwo(block, inUse, scale_);
        } else {
            pressing = contactRowKernels()->takeOne(block, inUse, scale_);
        }
        std::uint32_t began = 0;
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            Contact& contact = group_.contacts[links[lane].source];
            for (std::size_t k = 0; k < kPoints; ++k) {
                contact.totalImpulse[k] = block.points[k].totalNormalImpulse[lane];
            }
            const bool presses = ((pressing[0] | pressing[1]) >> lane & 1U) != 0;
            began |= (std::uint32_t{presses} & std::uint32_t{!contact.pressed}) << lane;
            contact.pressedOn = contact.pressed && presses;
            contact.pressed = presses;
        }
        LanesByPoint struck{};
        for (std::size_t k = 0; k < kPoints; ++k) { struck[k] = pressing[k] & (block.unloaded[k] | began); }
        if ((struck[0] | struck[1]) != 0) { noteHits(block, links, struck, began); }
        links = links.subspan(kBlockLanes);
    }
}

/// @param struck  points that began to press
/// @param began   one bit per lane of those that did not press before at all
template <std::size_t kPoints>
void TiedContacts::noteHits(const WideContact<kPoints>& block, Links links, const LanesByPoint& struck,
                            std::uint32_t began) {
    for (std::uint32_t lanes = struck[0] | struck[1]; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        const Contact& contact = group_.contacts[links[lane].source];
        const ContactFrame frame = frameOf(contact, links[lane]);
        const Vec2 normal{block.normalX[lane], block.normalY[lane]};
        const TiedPair pair = hits_.pairOf(contact, slotAt(block.stateA[lane]), slotAt(block.stateB[lane]));
        std::array<Real, 2> speeds{};
        for (std::size_t k = 0; k < kPoints; ++k) {
            if ((struck[k] >> lane & 1U) != 0) {
                speeds[k] = pair.approachAt(constraintPointOf(contact.manifold.points[k], frame), normal);
            }
        }
        hits_.note(contact, normal, speeds, (began >> lane & 1U) != 0);
    }
}

void TiedContacts::takeConstraint(const ContactConstraint& constraint) {
    Contact& contact = group_.contacts[constraint.source];
    const auto kept = [this](Real impulse) { return scale_ == 1 ? impulse : impulse / scale_; };  // most often it is
    const bool pressedBefore = contact.pressed;
    LanesByPoint struck{};  // of one lane
    contact.pressed = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
        const ContactConstraintPoint& point = constraint.points[k];
        const bool presses = point.totalNormalImpulse > 0;
        struck[k] = presses && (!pressedBefore || contact.normalImpulse[k] == 0) ? 1 : 0;
        contact.normalImpulse[k] = kept(point.normalImpulse);
        contact.tangentImpulse[k] = kept(point.tangentImpulse);
        contact.totalImpulse[k] = point.totalNormalImpulse;
        contact.pressed = contact.pressed || presses;
    }
    if (contact.rolls()) { contact.rollingImpulse() = kept(constraint.rollingImpulse); }
    contact.pressedOn = pressedBefore && contact.pressed;
    if ((struck[0] | struck[1]) != 0) { noteHit(contact, constraint, struck, !pressedBefore); }
}

/// @param struck  points that began to press
/// @param began   whether it did not press before at all
void TiedContacts::noteHit(const Contact& contact, const ContactConstraint& constraint, const LanesByPoint& struck,
                           bool began) {
    const TiedPair pair = hits_.pairOf(contact, constraint.slotA, constraint.slotB);
    std::array<Real, 2> speeds{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
        const ContactConstraintPoint& point = constraint.points[k];
        if (struck[k] == 0) { continue; }
        speeds[k] = std::max(point.bounceApproach, pair.approachAt(point, constraint.normal));
    }
    hits_.note(contact, constraint.normal, speeds, began);
}

}  // namespace swept::inline SWEPT_PRECISION
