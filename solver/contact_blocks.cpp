#include "contact_blocks.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const ContactKernels* contactKernels() { return nullptr; }
#endif

namespace {

/// A block with fewer contacts costs more than they do one by one.
constexpr std::size_t kFewestLanes = 2;

void fillPoint(WideContactPoint& lanes, std::size_t lane, const ContactConstraintPoint& point) {
    lanes.anchorAX[lane] = point.anchorA.x;
    lanes.anchorAY[lane] = point.anchorA.y;
    lanes.anchorBX[lane] = point.anchorB.x;
    lanes.anchorBY[lane] = point.anchorB.y;
    lanes.baseSeparation[lane] = point.baseSeparation;
    lanes.normalMass[lane] = point.normalMass;
    lanes.tangentMass[lane] = point.tangentMass;
    lanes.normalImpulse[lane] = point.normalImpulse;
    lanes.tangentImpulse[lane] = point.tangentImpulse;
    lanes.totalNormalImpulse[lane] = point.totalNormalImpulse;
    lanes.separation[lane] = 0;
}

template <std::size_t kPoints>
void fillLane(WideContact<kPoints>& block, std::size_t lane, const ContactConstraint& contact, const BodyInertia& a,
              const BodyInertia& b) {
    const bool begins = isBeginning(contact);
    block.slotA[lane] = contact.slotA;
    block.slotB[lane] = contact.slotB;
    block.movableA |= (isMovable(a) ? 1U : 0U) << lane;
    block.movableB |= (isMovable(b) ? 1U : 0U) << lane;
    block.anyBegins = block.anyBegins || begins;
    block.anyBounces = block.anyBounces || contact.restitution > 0;
    block.begins[lane] = begins ? Real(1) : Real(0);
    block.normalX[lane] = contact.normal.x;
    block.normalY[lane] = contact.normal.y;
    block.friction[lane] = contact.friction;
    block.maxPushSpeed[lane] = contact.maxPushSpeed;
    block.bounceSpeed[lane] = contact.bounceSpeed;
    block.biasRate[lane] = contact.softness.biasRate;
    block.massScale[lane] = contact.softness.massScale;
    block.impulseScale[lane] = contact.softness.impulseScale;
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
    for (std::size_t i = 0; i < kPoints; ++i) {
        fillPoint(block.points[i], lane, contact.points[i]);
    }
}

/// @param places  at most as many as there are lanes
template <std::size_t kPoints>
void fillBlock(WideContact<kPoints>& block, const SolverBatch& batch, std::span<const std::uint32_t> places) {
    block.movableA = block.movableB = 0;
    block.anyBegins = block.anyBounces = false;
    block.lanes = static_cast<std::uint32_t>(places.size());
    for (std::size_t lane = 0; lane < places.size(); ++lane) {
        const ContactConstraint& contact = batch.contacts[places[lane]];
        block.place[lane] = places[lane];
        fillLane(block, lane, contact, batch.inertias[contact.slotA], batch.inertias[contact.slotB]);
    }
    for (std::size_t lane = places.size(); lane < kBlockLanes; ++lane) {
        fillLane(block, lane, {}, {}, {});
    }
}

/// Visits each contact of blocks in the batch with its block and lane.
template <class Block, class Visit>
void forEachLane(std::span<Block> blocks, std::vector<ContactConstraint>& contacts, Visit&& visit) {
    for (Block& block : blocks) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            visit(contacts[block.place[lane]], block, lane);
        }
    }
}

}  // namespace

void ContactBlocks::sortColour(const SolverBatch& batch, std::span<const std::uint32_t> places) {
    withOne_.clear();
    withTwo_.clear();
    beginning_.clear();
    for (const std::uint32_t place : places) {
        const ContactConstraint& contact = batch.contacts[place];
        if (contact.isHeld || contact.count < 1) {
            rest_.push_back(place);
        } else if (contact.count == 1) {
            withOne_.push_back(place);
        } else {
            (isBeginning(contact) ? beginning_ : withTwo_).push_back(place);
        }
    }
    // Those that begin share as few blocks as can be: there all lanes take the longer way.
    withTwo_.insert(withTwo_.end(), beginning_.begin(), beginning_.end());
}

template <std::size_t kPoints>
ColourRange ContactBlocks::fill(const SolverBatch& batch, std::span<const std::uint32_t> places, Blocks<kPoints>& to) {
    const std::uint32_t begin = to.count;
    while (places.size() >= kFewestLanes) {
        const std::size_t lanes = std::min(places.size(), kBlockLanes);
        if (to.count == to.blocks.size()) {
            to.blocks.emplace_back();
        }
        fillBlock(to.blocks[to.count], batch, places.first(lanes));
        anyBounces_ = anyBounces_ || to.blocks[to.count].anyBounces;
        ++to.count;
        places = places.subspan(lanes);
    }
    rest_.insert(rest_.end(), places.begin(), places.end());
    return {begin, to.count};
}

void ContactBlocks::build(SolverBatch& batch, const ConstraintGraph& graph, bool wide, bool prepared) {
    kernels_ = wide ? contactKernels() : nullptr;
    one_.count = two_.count = 0;
    anyBounces_ = false;
    rest_.clear();
    for (const int c : graph.activeColours()) {
        Colour& colour = colours_[static_cast<std::size_t>(c)];
        const std::span<const std::uint32_t> places = graph.contactsOf(c);
        colour = {};
        colour.rest.begin = static_cast<std::uint32_t>(rest_.size());
        if (kernels_ != nullptr && c != kOverflowColour) {
            sortColour(batch, places);
            colour.two = fill(batch, withTwo_, two_);
            colour.one = fill(batch, withOne_, one_);
        } else {
            rest_.insert(rest_.end(), places.begin(), places.end());
        }
        colour.rest.end = static_cast<std::uint32_t>(rest_.size());
    }
    if (prepared) {
        return;
    }
    for (const std::uint32_t place : rest_) {
        prepareContact(batch.contacts[place], batch.inertias);
    }
    if (two_.count > 0) {
        kernels_->prepareTwo(std::span(two_.blocks).first(two_.count));
    }
    if (one_.count > 0) {
        kernels_->prepareOne(std::span(one_.blocks).first(one_.count));
    }
}

std::size_t ContactBlocks::countOf(int colour) const {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    return (ranges.two.end - ranges.two.begin) + (ranges.one.end - ranges.one.begin) +
           (ranges.rest.end - ranges.rest.begin);
}

void ContactBlocks::warmStart(SolverBatch& batch, int colour, RangeCut cut) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(two_.blocks, ranges.two); !blocks.empty()) {
        kernels_->warmStartTwo(blocks, bodies);
    }
    if (const auto blocks = cut.next(one_.blocks, ranges.one); !blocks.empty()) {
        kernels_->warmStartOne(blocks, bodies);
    }
    warmStartContacts(batch.contacts, cut.next(rest_, ranges.rest), bodies);
}

void ContactBlocks::solve(SolverBatch& batch, int colour, RangeCut cut, const ContactPass& pass) {
    const Colour& ranges = colours_[static_cast<std::size_t>(colour)];
    const SolverBodies bodies{batch.states, batch.inertias};
    if (const auto blocks = cut.next(two_.blocks, ranges.two); !blocks.empty()) {
        kernels_->solveTwo(blocks, bodies, pass);
    }
    if (const auto blocks = cut.next(one_.blocks, ranges.one); !blocks.empty()) {
        kernels_->solveOne(blocks, bodies, pass);
    }
    solveContacts(batch.contacts, cut.next(rest_, ranges.rest), bodies, pass);
}

void ContactBlocks::addUpBouncing(SolverBatch& batch) const {
    if (!anyBounces_) {
        return;
    }
    const auto addUp = [](ContactConstraint& contact, const auto& block, std::size_t lane) {
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            contact.points[i].totalNormalImpulse += block.points[i].normalImpulse[lane];
        }
    };
    const auto addUpAll = [&](const auto& blocks) {
        for (std::size_t i = 0; i < blocks.count; ++i) {
            if (blocks.blocks[i].anyBounces) {
                forEachLane(std::span(&blocks.blocks[i], 1), batch.contacts, addUp);
            }
        }
    };
    addUpAll(two_);
    addUpAll(one_);
}

void ContactBlocks::readBack(SolverBatch& batch) const {
    const auto read = [](ContactConstraint& contact, const auto& block, std::size_t lane) {
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            ContactConstraintPoint& point = contact.points[i];
            point.normalImpulse = block.points[i].normalImpulse[lane];
            point.tangentImpulse = block.points[i].tangentImpulse[lane];
            if (!block.anyBounces) {
                point.totalNormalImpulse = block.points[i].totalNormalImpulse[lane];
            }
        }
    };
    forEachLane(std::span(two_.blocks).first(two_.count), batch.contacts, read);
    forEachLane(std::span(one_.blocks).first(one_.count), batch.contacts, read);
}

}  // namespace swept::inline SWEPT_PRECISION
