#include <algorithm>
#include <cmath>
#include <limits>

#include "direct_parts.h"
#include "direct_solver.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounds of Newton's method for given limits of friction: one at rest, a few where something gives. What takes longer
/// goes to and fro between two pieces, as rows do that are too stiff. Among many bodies there are more pieces to go
/// through: walls of a thousand bricks that find their first impulses take up to 17, with 12 they were given up.
constexpr int kMostRounds = 12;
constexpr int kMostRoundsOfPatient = 40;
/// The same for a whole solve: a web of 256 bodies that never settles must not stop the world. The first few are not
/// counted, the others all solves of a step share.
constexpr int kMostRoundsOfSolve = 48;
constexpr int kUsualRoundsOfSolve = 4;
/// Whoever is held otherwise after so many rounds of a solve asks for more than half of what is usual in a sub-step
/// (effort.cpp).
constexpr int kRoundsOfNoNote = 3;
constexpr int kMostRoundsOfPatientSolve = 150;
/// Dampers are then made weaker by this, as often as that. What they leave is mended by the next solve. Among many
/// bodies less at a time: with 1/64 the first solves of a pyramid of 1275 boxes left 2 cm/s, with 1/8 0.2 mm/s.
constexpr double kWeaker = 1.0 / 64;
constexpr double kWeakerOfPatient = 1.0 / 8;
constexpr double kWeakest = kWeaker * kWeaker;
/// Rounds in which the limits follow the normal impulses.
constexpr int kMostLimitRounds = 8;
/// Among many bodies a point of no known limit of friction may part as often in the search for its first impulses. (One
/// of the 586 stones of a wall went to and fro until the rounds were used up, and the search began anew with weaker
/// dampers; of 2000 stones it was given up.) Few bodies find their way with weaker dampers in fewer rounds:
/// slender-and-tiny took 1.3 times as many with this, in the mean of twenty strengths of gravity.
constexpr int kMostPartings = 2;
/// Limits that are wrong by no more than this part are left to the next solve.
constexpr double kLimitTolerance = 1.0 / 64;
/// Impulses that a solve changed by more than this part of the largest are solved for again around the new ones, at
/// most so many times.
constexpr double kFarRatio = 1.0 / 64;
constexpr int kMostTightenings = 4;
/// What comes nearer by more than this part of what it did, after some of them, is not stopped by more.
constexpr double kLeftOfSqueezed = 1.0 / 8;
/// Impulses this much smaller than the largest in the island mean nothing: what is at the brink stays as it was.
constexpr double kBrinkRatio = 1.0 / (1 << 20);
/// A search along a line ends when its slope has fallen to this part.
constexpr double kSlopeRatio = 1.0 / 16;
constexpr int kMostLineSteps = 12;

}  // namespace

void DirectSolver::listContacts(SolverBatch& batch) {
    // They are large: room is made at once, not in steps of which each is copied and given back.
    std::size_t points = 0;
    for (const ContactConstraint& contact : batch.contacts) { points += static_cast<std::size_t>(contact.count); }
    if (contacts_.capacity() < points) { contacts_.reserve(std::max(points, 2 * contacts_.capacity())); }
    for (ContactConstraint& contact : batch.contacts) {
        const std::uint32_t a = nodeOf_[contact.slotA];
        const std::uint32_t b = nodeOf_[contact.slotB];
        if (a == kNoNode && b == kNoNode) { continue; }
        const std::uint32_t island = islands_.find(a != kNoNode ? a : b);
        for (int i = 0; i < contact.count; ++i) {
            ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
            contacts_.push_back({.contact = &contact,
                                 .point = &point,
                                 .island = island,
                                 .normal = rowOf(batch, normalRowOf(contact, point, 0)),
                                 .tangent = rowOf(batch, tangentRowOf(contact, point))});
        }
    }
}

void DirectSolver::beginFirstHalf() {
    for (ContactPoint& contact : contacts_) {
        contact.half = contact.point->normalImpulse *= Real(0.5);
        contact.tangentHalf = contact.point->tangentImpulse *= Real(0.5);
    }
}

void DirectSolver::beginSecondHalf() {
    for (ContactPoint& contact : contacts_) {
        contact.first = contact.point->normalImpulse;
        contact.tangentFirst = contact.point->tangentImpulse;
        contact.point->normalImpulse = contact.half;
        contact.point->tangentImpulse = contact.tangentHalf;
    }
}

void DirectSolver::addHalves() {
    for (const ContactPoint& contact : contacts_) {
        contact.point->normalImpulse += contact.first;
        contact.point->tangentImpulse += contact.tangentFirst;
    }
}

void DirectSolver::gatherContacts(const SolverBatch& batch, Real h, bool useBias) {
    for (ContactPoint& contact : contacts_) {
        const ContactConstraint& constraint = *contact.contact;
        const ContactConstraintPoint& point = *contact.point;
        const BodyState& a = batch.states[constraint.slotA];
        const BodyState& b = batch.states[constraint.slotB];
        const Real expected = useBias ? point.normalImpulse : contact.first;
        const Real separation = useBias ? currentSeparation(constraint, point, a, b) : Real(0);
        const Real bias = !(expected > 0) && separation > 0 ? separation / h : Real(0);
        const Real closing = -dot(velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA), constraint.normal);
        // What bounces must arrive in the next sub-step with its speed.
        const bool isOut = !useBias && (!(expected > 0) || closing > constraint.bounceSpeed);
        const bool presses = !isOut && (expected > 0 || (closing >= bias && !(separation > 0)));
        contact.normal.guess = isOut ? 0 : static_cast<double>(point.normalImpulse);
        contact.tangent.guess = isOut ? 0 : static_cast<double>(point.tangentImpulse);
        contact.normal.impulse = contact.tangent.impulse = 0;
        contact.normal.excess = excessOf(batch, normalRowOf(constraint, point, bias));
        contact.tangent.excess = excessOf(batch, tangentRowOf(constraint, point));
        // What touches and does not part is guessed to press, and to stick: a stack that comes down comes down on all
        // its contacts.
        contact.limit = static_cast<double>(constraint.friction) * contact.normal.guess;
        const bool isNew = !(point.normalImpulse > 0);
        if (isNew && constraint.friction > 0) { contact.limit = std::numeric_limits<double>::infinity(); }
        contact.isExpected = presses;
        contact.partings = 0;
        contact.normalHold = isOut ? Hold::free : Hold::held;
    }
    guessHolds();
}

void DirectSolver::guessHolds() {
    for (ContactPoint& contact : contacts_) {
        if (contact.normalHold == Hold::free) {
            contact.tangentHold = Hold::free;
            continue;
        }
        const bool sticks = contact.isExpected && std::fabs(contact.tangent.guess) < contact.limit;
        contact.normalHold = contact.isExpected ? Hold::held : Hold::forced;
        contact.tangentHold = sticks ? Hold::held : Hold::forced;
        contact.normal.impulse = contact.tangent.impulse = 0;
        if (!sticks && contact.isExpected && !std::isinf(contact.limit)) {
            contact.tangent.impulse = std::clamp(contact.tangent.guess, -contact.limit, contact.limit);
        }
    }
}

void DirectSolver::findNoise() {
    for (const ContactPoint& contact : contacts_) {
        double& noise = noise_[contact.island];
        noise = std::max(noise, kBrinkRatio * contact.normal.guess);
        if (contact.normalHold == Hold::held) {
            const Row& row = contact.normal;
            noise = std::max(noise, kBrinkRatio * (row.guess - strength_ * row.strength * changedExcess(row)));
        }
    }
}

bool DirectSolver::noted(const ContactPoint& contact, bool isOther) {
    if (isOther && roundsLeft_ <= notedFrom_) { takesLong_[contact.island] = 1; }
    return isOther;
}

/// Impulses and holds by what the dampers say at `change_`.
/// @param isFirm  what is at the brink stays as it was
/// @return whether anything is held otherwise than before
bool DirectSolver::classify(bool isFirm) {
    bool changed = false;
    for (ContactPoint& contact : contacts_) {
        if (contact.normalHold == Hold::free) { continue; }
        bool isOther = false;
        const auto set = [&isOther](Hold& hold, Hold now) {
            isOther = isOther || hold != now;
            hold = now;
        };
        const double brink = isFirm ? noise_[contact.island] : 0;
        Row& normal = contact.normal;
        Row& tangent = contact.tangent;
        const double pressed = normal.guess - strength_ * normal.strength * changedExcess(normal);
        const bool presses = pressed > (contact.normalHold == Hold::held ? -brink : brink);
        if (isPatient_ && contact.normalHold == Hold::held && !presses && std::isinf(contact.limit)) {
            // What holds without limit once it presses, and then carries much, parts its bodies, so that it does not
            // press: no minimum lies between. It is taken to slide, until it is known how much it presses.
            if (++contact.partings >= kMostPartings) { contact.limit = 0; }
        }
        set(contact.normalHold, presses ? Hold::held : Hold::forced);
        normal.impulse = presses ? pressed : 0;
        // A limit that is not known yet holds as long as the point presses.
        const double limit = std::isinf(contact.limit) && !presses ? 0 : contact.limit;
        const double rubbed = tangent.guess - strength_ * tangent.strength * changedExcess(tangent);
        const bool sticks =
            limit > 0 && std::fabs(rubbed) <= limit + (contact.tangentHold == Hold::held ? brink : -brink);
        const double before = tangent.impulse;
        tangent.impulse = sticks ? rubbed : std::clamp(rubbed, -limit, limit);
        isOther = isOther || (!sticks && contact.tangentHold == Hold::forced && before * tangent.impulse < 0);
        set(contact.tangentHold, sticks ? Hold::held : Hold::forced);
        changed = noted(contact, isOther) || changed;
    }
    return changed;
}

double DirectSolver::slopeAt(double part) const {
    double slope = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = nodes_[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const double way = change_[i][k] - place_[i][k];
            slope += (k < 2 ? node.mass : node.inertia) * way * (place_[i][k] + part * way);
        }
    }
    for (const ContactPoint& contact : contacts_) {
        if (contact.normalHold == Hold::free) { continue; }
        const auto impulseOf = [this, part](const Row& row, double least, double most) {
            return std::clamp(row.guess - strength_ * row.strength * (row.at + part * row.along), least, most);
        };
        const double pressed = impulseOf(contact.normal, 0, std::numeric_limits<double>::infinity());
        const double limit = std::isinf(contact.limit) && !(pressed > 0) ? 0 : contact.limit;
        slope -= pressed * contact.normal.along + impulseOf(contact.tangent, -limit, limit) * contact.tangent.along;
    }
    return slope;
}

/// From `place_` towards `change_`, to about the lowest point of the function. @return the part of the way
double DirectSolver::searchLine() {
    for (ContactPoint& contact : contacts_) {
        for (Row* const row : {&contact.normal, &contact.tangent}) {
            const double there = changedExcess(*row);
            std::swap(change_, place_);
            row->at = changedExcess(*row);
            std::swap(change_, place_);
            row->along = there - row->at;
        }
    }
    double high = 1;
    double highSlope = slopeAt(1);
    double low = 0;
    double lowSlope = slopeAt(0);
    if (!(highSlope > 0) || !(lowSlope < 0)) { return 1; }
    const double small = -kSlopeRatio * lowSlope;
    for (int i = 0; i < kMostLineSteps; ++i) {
        const double secant = low + (high - low) * (lowSlope / (lowSlope - highSlope));
        const double middle = i % 2 == 0 ? secant : 0.5 * (low + high);
        const double slope = slopeAt(middle);
        if (std::fabs(slope) <= small) { return middle; }
        (slope < 0 ? low : high) = middle;
        (slope < 0 ? lowSlope : highSlope) = slope;
    }
    return low > 0 ? low : high;
}

/// The minimum for the limits of friction that there are. @return whether it was found
template <bool kJoints>
bool DirectSolver::settle(DirectReport& report) {
    bool hasPlace = false;
    const int mostRounds = isPatient_ ? kMostRoundsOfPatient : kMostRounds;
    for (int round = 0; round < mostRounds && roundsLeft_-- > 0; ++round) {
        if (!holdsAsBefore()) { assemble<kJoints>(report); }
        computeChange<kJoints>();
        ++report.rounds;
        if (round == 0) { findNoise(); }
        if (!classify(true)) { return true; }
        if (hasPlace) {
            const double part = searchLine();
            if (part < 1) {
                for (std::size_t i = 0; i < change_.size(); ++i) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        change_[i][k] = place_[i][k] + part * (change_[i][k] - place_[i][k]);
                    }
                }
                classify(false);
            }
        }
        place_ = change_;
        hasPlace = true;
    }
    return false;
}

/// @return whether some limit was too far from what its normal impulse says
bool DirectSolver::followLimits() {
    bool isFar = false;
    for (ContactPoint& contact : contacts_) {
        if (contact.normalHold == Hold::free) { continue; }
        // What is at the brink may be held by a trace less than nothing.
        const double limit = static_cast<double>(contact.contact->friction) * std::max(contact.normal.impulse, 0.0);
        const double rubbed = std::fabs(contact.tangent.impulse);
        const double slack = kLimitTolerance * limit + noise_[contact.island];
        const bool isTooStrong = rubbed > limit + slack;
        const bool isTooWeak = contact.tangentHold == Hold::forced && rubbed + slack < limit;
        isFar = noted(contact, isTooStrong || isTooWeak) || isFar;
        contact.limit = limit;
    }
    return isFar;
}

/// Impulses that moved far are where dampers still give way: around the new ones they do so by a small part of that.
/// @return whether there were any
bool DirectSolver::tighten() {
    bool isFar = false;
    for (const ContactPoint& contact : contacts_) {
        const double change = std::fabs(contact.normal.impulse - contact.normal.guess);
        const double rub = std::fabs(contact.tangent.impulse - contact.tangent.guess);
        const bool isTooFar = std::max(change, rub) > kFarRatio * (noise_[contact.island] / kBrinkRatio);
        isFar = noted(contact, isTooFar) || isFar;
    }
    if (!isFar) { return false; }
    for (ContactPoint& contact : contacts_) {
        if (contact.normalHold == Hold::free) { continue; }
        contact.normal.guess = contact.normal.impulse;
        contact.tangent.guess = contact.tangent.impulse;
    }
    return true;
}

/// Whether something is between a kinematic body that comes and what does not yield: it still comes nearer, as fast as
/// if nothing pressed. No impulses stop that. Each solve would add as much again, until friction with such impulses
/// flings the body away, when iteration takes over. (A box of 0.4 kg under a lift of 1.6 m/s: 5e4 N·s in a sub-step,
/// 7 km/s.)
bool DirectSolver::isSqueezed(const SolverBatch& batch) {
    const auto moves = [&batch](BodySlot slot) {
        const BodyState& state = batch.states[slot];
        return !isMovable(batch.inertias[slot]) && (state.velocity != Vec2{} || state.angularVelocity != 0);
    };
    bool any = false;
    for (const ContactPoint& contact : contacts_) {
        const Row& normal = contact.normal;
        if (contact.normalHold != Hold::held || !(normal.excess < 0)) { continue; }
        if (!moves(contact.contact->slotA) && !moves(contact.contact->slotB)) { continue; }
        if (changedExcess(normal) >= kLeftOfSqueezed * normal.excess) { continue; }
        takesLong_[contact.island] = 1;
        any = true;
    }
    return any;
}

template <bool kJoints>
bool DirectSolver::findImpulses(DirectReport& report) {
    const int most = isPatient_ ? kMostRoundsOfPatientSolve
                                : std::min(kMostRoundsOfSolve, kUsualRoundsOfSolve + std::max(spareRounds_, 0));
    roundsLeft_ = most;
    notedFrom_ = most - kRoundsOfNoNote;
    const bool isFound = searchImpulses<kJoints>(report);
    spareRounds_ -= std::max(most - roundsLeft_ - kUsualRoundsOfSolve, 0);
    return isFound;
}

template <bool kJoints>
bool DirectSolver::searchImpulses(DirectReport& report) {
    noise_.assign(nodes_.size(), 0);
    hasTightened_ = false;
    strength_ = 1;
    if (contacts_.empty()) {
        if (!holdsAsBefore()) { assemble<kJoints>(report); }
        computeChange<kJoints>();
        if constexpr (kJoints) { searchDrives(report); }
        return true;
    }
    const double weaker = isPatient_ ? kWeakerOfPatient : kWeaker;
    int tightenings = 0;
    for (int round = 0; round < kMostLimitRounds; ++round) {
        while (!settle<kJoints>(report)) {
            if (!(strength_ > kWeakest) || roundsLeft_ <= 0) { return false; }
            strength_ *= weaker;
            guessHolds();
        }
        if (!followLimits()) {
            if (tightenings == kMostTightenings || !tighten()) { break; }
            ++tightenings;
        }
        classify(false);
    }
    hasTightened_ = tightenings > 0;
    return true;
}

template bool DirectSolver::findImpulses<false>(DirectReport&);
template bool DirectSolver::findImpulses<true>(DirectReport&);

}  // namespace swept::inline SWEPT_PRECISION
