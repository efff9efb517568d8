#include "direct_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounds of Newton's method for given limits of friction: one at rest, a few where something gives. What takes longer
/// goes to and fro between two pieces, as rows do that are too stiff. Among many bodies there are more pieces to go
/// through: walls of a thousand bricks that find their first impulses take up to 17, with 12 they were given up.
constexpr int kMostRounds = 12;
constexpr int kMostRoundsOfMany = 40;
/// The same for a whole solve: a web of 256 bodies that never settles must not stop the world. The first few are not
/// counted, the others all solves of a step share.
constexpr int kMostRoundsOfSolve = 48;
constexpr int kMostRoundsOfManySolve = 150;  ///< of many bodies (`kMostRoundsOfMany`)
constexpr int kUsualRoundsOfSolve = 4;
/// Whoever is held otherwise after so many rounds of a solve asks for more than half of what is usual in a sub-step
/// (effort.cpp).
constexpr int kRoundsOfNoNote = 3;
/// Dampers are then made weaker by this, as often as that. What they leave is mended by the next solve. Among many
/// bodies less at a time: with 1/64 the first solves of a pyramid of 1275 boxes left 2 cm/s, with 1/8 0.2 mm/s.
constexpr double kWeaker = 1.0 / 64;
constexpr double kWeakerOfMany = 1.0 / 8;
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
/// Impulses this much smaller than the largest in the island mean nothing: what is at the brink stays as it was.
constexpr double kBrinkRatio = 1.0 / (1 << 20);
/// A search along a line ends when its slope has fallen to this part.
constexpr double kSlopeRatio = 1.0 / 16;
constexpr int kMostLineSteps = 12;

/// What of a contact point is in the matrix, as one number.
constexpr int kPresses = 1;
constexpr int kSticks = 2;
constexpr std::uint8_t holdsOf(bool presses, bool sticks) {
    return static_cast<std::uint8_t>((presses ? kPresses : 0) + (sticks ? kSticks : 0));
}
/// Rows that may differ from those of the factor before there is a new one: each costs about 1/40 of that.
constexpr int kMostChanges = 16;

}  // namespace

void DirectContacts::assemble(const Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report,
                              double tangentShare) {
    system.beginMatrix(part.nodes);
    joints.addTo(system);
    holds_.resize(points_.size());
    for (std::size_t i = part.begin; i < part.end; ++i) {
        const Point& contact = points_[i];
        const bool presses = contact.normalHold == Hold::held;
        const bool sticks = contact.tangentHold == Hold::held;
        holds_[i] = holdsOf(presses, sticks);
        if (presses) { system.add(contact.normal); }
        if (sticks) { system.add(contact.tangent, tangentShare); }
    }
    system.factorise(part.nodes);
    ++report.factorisations;
}

void DirectContacts::computeChange(const Part& part, DirectSystem& system, const DirectJoints& joints) const {
    system.beginChange(part.nodes);
    joints.push(system);
    const auto push = [&system](const SystemRow& row, Hold hold) {
        if (hold == Hold::held) {
            system.push(row, system.pullOf(row, row.excess));
        } else if (hold == Hold::forced) {
            system.push(row, row.impulse);
        }
    };
    for (const Point& contact : pointsOf(part)) {
        push(contact.normal, contact.normalHold);
        push(contact.tangent, contact.tangentHold);
    }
    system.solve(part.nodes);
}

void DirectContacts::computeProjection(DirectSystem& system, const DirectJoints& joints, DirectReport& report,
                                       double tangentShare) {
    DirectReport most;
    system.beginChange();
    for (Part& part : parts_) {
        if (!part.isFar) { continue; }
        DirectReport own;
        assemble(part, system, joints, own, tangentShare);
        computeChange(part, system, joints);
        if (isOverfull(part, system)) {
            part.isInVain = true;
            system.beginChange(part.nodes);  // nothing moves
        }
        limitMoves(part, system);
        system.forgetFactor(part.nodes);
        most.takeLarger(own);
    }
    report.add(most);
}

/// Takes up the factor that there is: as it is, or among many bodies with what changed since. @return whether it serves
bool DirectContacts::takeUpFactor(const Part& part, DirectSystem& system, const DirectJoints& joints) const {
    system.forgetChanges();
    if (!system.isFactorised(part.nodes) || !joints.isEmpty()) { return false; }
    const auto changesOf = [this](std::size_t i) {
        return holds_[i] ^ holdsOf(points_[i].normalHold == Hold::held, points_[i].tangentHold == Hold::held);
    };
    const int most = part.isWide ? kMostChanges : 0;
    int count = 0;
    for (std::size_t i = part.begin; i < part.end && count <= most; ++i) {
        const int changes = changesOf(i);
        count += (changes & kPresses) + (changes & kSticks) / kSticks;
    }
    if (count > most) { return false; }
    for (std::size_t i = part.begin; i < part.end && count > 0; ++i) {
        const int changes = changesOf(i);
        const Point& contact = points_[i];
        if ((changes & kPresses) != 0) { system.change(contact.normal, contact.normalHold == Hold::held, part.nodes); }
        if ((changes & kSticks) != 0) { system.change(contact.tangent, contact.tangentHold == Hold::held, part.nodes); }
    }
    return true;
}

void DirectContacts::guessHolds(std::span<Point> points) {
    for (Point& contact : points) {
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

void DirectContacts::findNoise(const Part& part, const DirectSystem& system) {
    for (const Point& contact : pointsOf(part)) {
        double& noise = noise_[contact.island];
        noise = std::max(noise, kBrinkRatio * contact.normal.guess);
        if (contact.normalHold == Hold::held) {
            const SystemRow& row = contact.normal;
            noise = std::max(noise, kBrinkRatio * system.pullOf(row, system.changedExcess(row)));
        }
    }
}

bool DirectContacts::noted(const Point& contact, bool isOther) {
    if (isOther && roundsLeft_ <= notedFrom_) { takesLong_[contact.island] = 1; }
    return isOther;
}

/// Impulses and holds by what the dampers say after the change.
/// @param isFirm  what is at the brink stays as it was
/// @return whether anything is held otherwise than before
bool DirectContacts::classify(const Part& part, const DirectSystem& system, bool isFirm) {
    bool changed = false;
    for (Point& contact : pointsOf(part)) {
        if (contact.normalHold == Hold::free) { continue; }
        bool isOther = false;
        const auto set = [&isOther](Hold& hold, Hold now) {
            isOther = isOther || hold != now;
            hold = now;
        };
        const double brink = isFirm ? noise_[contact.island] : 0;
        SystemRow& normal = contact.normal;
        SystemRow& tangent = contact.tangent;
        const double pressed = system.pullOf(normal, system.changedExcess(normal));
        const bool presses = pressed > (contact.normalHold == Hold::held ? -brink : brink);
        if (hasManyBodies_ && contact.normalHold == Hold::held && !presses && std::isinf(contact.limit)) {
            // What holds without limit once it presses, and then carries much, parts its bodies, so that it does not
            // press: no minimum lies between. It is taken to slide, until it is known how much it presses.
            if (++contact.partings >= kMostPartings) { contact.limit = 0; }
        }
        set(contact.normalHold, presses ? Hold::held : Hold::forced);
        normal.impulse = presses ? pressed : 0;
        // A limit that is not known yet holds as long as the point presses.
        const double limit = std::isinf(contact.limit) && !presses ? 0 : contact.limit;
        const double rubbed = system.pullOf(tangent, system.changedExcess(tangent));
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

/// @param share  of the way
double DirectContacts::slopeAt(const Part& part, const DirectSystem& system, double share) const {
    const std::span<const Block3> change = system.change();
    double slope = 0;
    for (std::size_t i = part.nodes.begin; i < part.nodes.end; ++i) {
        const DirectSystem::Node& node = system.nodes()[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const double way = change[i][k] - place_[i][k];
            slope += (k < 2 ? node.mass : node.inertia) * way * (place_[i][k] + share * way);
        }
    }
    for (const Point& contact : pointsOf(part)) {
        if (contact.normalHold == Hold::free) { continue; }
        const auto impulseOf = [&system, share](const SystemRow& row, double least, double most) {
            return std::clamp(system.pullOf(row, row.at + share * row.along), least, most);
        };
        const double pressed = impulseOf(contact.normal, 0, std::numeric_limits<double>::infinity());
        const double limit = std::isinf(contact.limit) && !(pressed > 0) ? 0 : contact.limit;
        slope -= pressed * contact.normal.along + impulseOf(contact.tangent, -limit, limit) * contact.tangent.along;
    }
    return slope;
}

/// From `place_` towards the change, to about the lowest point of the function. @return the share of the way
double DirectContacts::searchLine(const Part& part, const DirectSystem& system) {
    for (Point& contact : pointsOf(part)) {
        for (SystemRow* const row : {&contact.normal, &contact.tangent}) {
            const double there = system.changedExcess(*row);
            row->at = DirectSystem::excessAfter(*row, place_);
            row->along = there - row->at;
        }
    }
    double high = 1;
    double highSlope = slopeAt(part, system, 1);
    double low = 0;
    double lowSlope = slopeAt(part, system, 0);
    if (!(highSlope > 0) || !(lowSlope < 0)) { return 1; }
    const double small = -kSlopeRatio * lowSlope;
    for (int i = 0; i < kMostLineSteps; ++i) {
        const double secant = low + (high - low) * (lowSlope / (lowSlope - highSlope));
        const double middle = i % 2 == 0 ? secant : 0.5 * (low + high);
        const double slope = slopeAt(part, system, middle);
        if (std::fabs(slope) <= small) { return middle; }
        (slope < 0 ? low : high) = middle;
        (slope < 0 ? lowSlope : highSlope) = slope;
    }
    return low > 0 ? low : high;
}

/// The minimum for the limits of friction that there are. @return whether it was found
bool DirectContacts::settle(const Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    const std::span<Block3> change = system.change();
    bool hasPlace = false;
    const int mostRounds = hasManyBodies_ ? kMostRoundsOfMany : kMostRounds;
    for (int round = 0; round < mostRounds && roundsLeft_-- > 0; ++round) {
        if (!takeUpFactor(part, system, joints)) { assemble(part, system, joints, report); }
        computeChange(part, system, joints);
        ++report.rounds;
        if (round == 0) { findNoise(part, system); }
        if (!classify(part, system, true)) { return true; }
        if (hasPlace) {
            const double share = searchLine(part, system);
            if (share < 1) {
                for (std::size_t i = part.nodes.begin; i < part.nodes.end; ++i) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        change[i][k] = place_[i][k] + share * (change[i][k] - place_[i][k]);
                    }
                }
                // Among many bodies rounding alone would let a hundred rows come and go, in a new factor.
                classify(part, system, part.isWide);
            }
        }
        std::copy(change.begin() + part.nodes.begin, change.begin() + part.nodes.end,
                  place_.begin() + part.nodes.begin);
        hasPlace = true;
    }
    return false;
}

/// @return whether some limit was too far from what its normal impulse says
bool DirectContacts::followLimits(const Part& part) {
    bool isFar = false;
    for (Point& contact : pointsOf(part)) {
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
bool DirectContacts::tighten(const Part& part) {
    bool isFar = false;
    for (const Point& contact : pointsOf(part)) {
        const double change = std::fabs(contact.normal.impulse - contact.normal.guess);
        const double rub = std::fabs(contact.tangent.impulse - contact.tangent.guess);
        const bool isTooFar = std::max(change, rub) > kFarRatio * (noise_[contact.island] / kBrinkRatio);
        isFar = noted(contact, isTooFar) || isFar;
    }
    if (!isFar) { return false; }
    for (Point& contact : pointsOf(part)) {
        if (contact.normalHold == Hold::free) { continue; }
        contact.normal.guess = contact.normal.impulse;
        if (part.isWide && contact.tangentHold == Hold::forced) {
            contact.tangent.impulse = std::clamp(contact.tangent.impulse, -contact.limit, contact.limit);
        }
        contact.tangent.guess = contact.tangent.impulse;
    }
    return true;
}

bool DirectContacts::searchIn(Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    part.mayBeSqueezed = false;
    const double weaker = hasManyBodies_ ? kWeakerOfMany : kWeaker;
    int tightenings = 0;
    int round = 0;
    for (; round < kMostLimitRounds; ++round) {
        while (!settle(part, system, joints, report)) {
            if (!(system.strength() > kWeakest) || roundsLeft_ <= 0) { return false; }
            system.setStrength(weaker * system.strength());
            guessHolds(pointsOf(part));
        }
        if (followLimits(part)) {
            classify(part, system, false);
            continue;
        }
        if (tightenings == kMostTightenings || !tighten(part)) { break; }
        ++tightenings;
        // What is held stays so. At the place where the search stands, dampers around the new impulses would say twice
        // what they gave way by: a third of all points were let go, and taken back in as many rounds.
        if (!part.isWide) { classify(part, system, false); }
    }
    part.mayBeSqueezed = tightenings > 0 || round == kMostLimitRounds;
    return true;
}

bool DirectContacts::searchPart(Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    const auto bodies = static_cast<std::int64_t>(part.nodes.end - part.nodes.begin);
    const std::int64_t spare = std::min<std::int64_t>(part.spareRounds, spareBodyRounds_ / bodies);
    const int most = hasManyBodies_ ? kMostRoundsOfManySolve
                                    : static_cast<int>(std::clamp<std::int64_t>(
                                          kUsualRoundsOfSolve + spare, kUsualRoundsOfSolve, kMostRoundsOfSolve));
    roundsLeft_ = most;
    notedFrom_ = most - kRoundsOfNoNote;
    system.setStrength(1);
    const bool isFound = searchIn(part, system, joints, report);
    const int unusual = std::max(most - roundsLeft_ - kUsualRoundsOfSolve, 0);
    part.isLong = isFound && unusual > 0;
    part.spareRounds -= unusual;
    spareBodyRounds_ -= unusual * bodies;
    return isFound;
}

bool DirectContacts::search(DirectSystem& system, const DirectJoints& joints, DirectReport& report) {
    noise_.assign(system.nodes().size(), 0);
    place_.resize(system.nodes().size());
    DirectReport most;
    bool isFound = true;
    for (Part& part : parts_) {
        DirectReport own;
        const bool isDone = searchPart(part, system, joints, own);
        part.isInVain = part.isInVain || !isDone;
        part.rounds += own.rounds;
        most.takeLarger(own);
        isFound = isFound && isDone;  // the others are searched all the same: so it is known which are in vain
    }
    report.add(most);
    return isFound;
}

}  // namespace swept::inline SWEPT_PRECISION
