#include "joint_island.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../direct/direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Suzuki's composition of five sub-steps, 1/(4 − ∛4) and what is left of 1.
constexpr double kOuterPart = 0.41449077179437573714;
constexpr double kMiddlePart = 1 - 4 * kOuterPart;
constexpr double kSuzuki[] = {kOuterPart, kOuterPart, kMiddlePart, kOuterPart, kOuterPart};
/// One composition takes the place of so many sub-steps.
constexpr int kSubStepsReplaced = 8;
/// Radians that bodies turn, or begin to turn, in a composition: the error goes by the fourth power. And radians of the
/// oscillation of light links under tension: explicit in the directions of forces, a sub-step is stable up to 2, and
/// the longest one is two thirds of its composition.
constexpr double kMostTurn = 0.5;
constexpr double kMostPhase = 1;
constexpr double kMostCompositions = 256;
/// Radians of that oscillation in a step beyond which sub-steps of trees go by their middle. These are stable at any
/// length; up to a few compositions more follow the oscillation while it is slow, and keep what it holds of the energy
/// (1000 : 1 on twenty links, let go level, ten seconds: 3e-5 of it; with two always 5e-4).
constexpr double kStiffPhase = 16;
constexpr double kMostPhaseByMiddle = 4;
constexpr double kMostForPhaseByMiddle = 4;
/// Masses farther apart than this leave too few digits of the light ones' accelerations.
constexpr double kMostSpreadOfFlow = 1 << 20;
/// Sub-steps with forces of their ends, times those asked for.
constexpr int kMostEndsFactor = 16;
/// The same times bodies, where that is less, but never less than the other: a long chain must not stop the world.
constexpr double kMostBodyCompositions = 8192;
constexpr double kFewestCompositions = 16;
/// A tree on joints can always go on: where it was not found how, sub-steps were too long, and are made so many times
/// as short, as often as that.
constexpr int kFiner = 4;
constexpr int kMostTries = 2;
constexpr int kMostSoftSubSteps = 64;
/// A step that changes the energy by more than this part of what went to and fro in it is none.
constexpr double kMostEnergyRatio = 1.0 / 64;
/// One that changes it by more than this is put right. How many sub-steps there are follows the motion, and so they are
/// shorter on the way into the crack of a whip than on the way out: without that a rope let go level gained its energy
/// four thousand times over in four minutes. Slower motions stay below, and keep their energy by themselves.
constexpr double kFineEnergyRatio = 0x1p-14;
/// Nor do speeds grow by more than this at once: where bodies all but stand still, they do not say what is missing.
constexpr double kMostGrowth = 9.0 / 8;
/// Radians of a turn in a step beyond which it is coarse: what may happen within it shows neither before nor after it.
constexpr double kCoarseTurn = 1;

bool isDamped(const IslandBody& body) { return body.decay != 1 || body.angularDecay != 1; }

/// Moved, and not by the island.
bool isCarrier(const IslandBody& body) {
    return body.column == kNoNode && (body.spin != 0 || dot(body.velocity, body.velocity) > 0);
}

double kineticEnergy(const std::vector<IslandBody>& bodies) {
    double twice = 0;
    for (const IslandBody& body : bodies) {
        if (body.inverseMass > 0) { twice += dot(body.velocity, body.velocity) / body.inverseMass; }
        if (body.inverseInertia > 0) { twice += body.spin * body.spin / body.inverseInertia; }
    }
    return 0.5 * twice;
}

}  // namespace

void JointIsland::clear() {
    bodies_.clear();
    holds_.clear();
    drives_.clear();
    woundSpeed_ = 0;
    isPaced_ = isSoft_ = isUndone_ = false;
}

void JointIsland::prepare() {
    if (isUndone_) { return; }
    columns_ = 0;
    for (IslandBody& body : bodies_) {
        const bool moves = body.inverseMass > 0 || body.inverseInertia > 0;
        body.column = moves ? columns_++ : kNoNode;
    }
    edges_.clear();
    for (const IslandHold& hold : holds_) {
        const std::uint32_t a = bodies_[hold.a].column;
        const std::uint32_t b = bodies_[hold.b].column;
        if (a != kNoNode && b != kNoNode && a != b) { edges_.push_back({a, b}); }
    }
    change_.resize(columns_);
    weigh();
    growTree();
}

void JointIsland::advance(double h, int subSteps, JointFlow& flow) {
    factorisations_ = subSteps_ = 0;
    if (isUndone_) { return; }
    start_ = bodies_;
    const Rates rates = ratesOf(h);
    int finer = 1;
    const int mostTries = isTree_ ? kMostTries : 1;
    const bool wasOpened = isOpen();
    keepsOpen_ = isTree_ && wasOpened;
    isSoft_ = false;
    if (mayFlow(h * subSteps, rates) && !wasOpened) {
        if (advanceSmoothly(h, subSteps, flow)) { return; }
        bodies_ = start_;
    }
    isUndone_ = !drives_.empty();
    if (isUndone_) { return; }
    // Who chooses islands for this sees to it that factors do not fill up.
    matrix_.analyse(columns_, edges_, std::numeric_limits<std::size_t>::max());
    isSoft_ = !isTree_ && wasOpened && !hasAccount();
    for (int tries = isSoft_ ? 0 : mostTries; tries > 0; --tries) {
        isSoft_ = false;
        isSoft_ = !advanceExactly(h, subSteps, finer, rates) || !keepsEnergy(h, subSteps, kineticEnergy(start_));
        if (!isSoft_) { break; }
        bodies_ = start_;
        dropForces();
        finer *= kFiner;
    }
    if (isSoft_) { advanceAnyhow(h, subSteps, rates); }
    if (keepsOpen_) { closeGaps(); }
}

/// Whether the accelerations of the bodies are found at once, and as smooth as steps are short.
bool JointIsland::mayFlow(double duration, const Rates& rates) const {
    if (!isTree_ || woundSpeed_ > 0 || duration * rates.phase > kStiffPhase) { return false; }
    double lightest = std::numeric_limits<double>::infinity();
    double heaviest = 0;
    for (const IslandBody& body : bodies_) {
        if (body.column == kNoNode) { continue; }
        if (!JointFlow::mayTake(body)) { return false; }
        lightest = std::min(lightest, 1 / body.inverseMass);
        heaviest = std::max(heaviest, 1 / body.inverseMass);
    }
    return heaviest <= kMostSpreadOfFlow * lightest;
}

bool JointIsland::advanceSmoothly(double h, int subSteps, JointFlow& flow) {
    flow.start({bodies_, holds_, branches_, drives_}, h);
    const double most = mostCompositions();
    const auto tremor = subSteps < kSubStepsReplaced ? JointFlow::Tremor::unseen : JointFlow::Tremor::followed;
    const bool isDone = flow.advance(h * subSteps, most, tremor);
    factorisations_ += flow.evaluations();
    subSteps_ += flow.pieces();
    if (!isDone) { return false; }
    dropTotals();
    flow.finish(bodies_, holds_, drives_);
    return keepsEnergy(h, subSteps, flow.begun());
}

/// Where the usual ways found no end.
void JointIsland::advanceAnyhow(double h, int subSteps, const Rates& rates) {
    for (int more = 1; isTree_ && more <= kMostEndsFactor; more *= kFiner) {
        if (advanceByEnds(h, subSteps, more)) {
            keepsEnergy(h, subSteps, kineticEnergy(start_));
            return;
        }
        bodies_ = start_;
        dropForces();
    }
    advanceSoftly(h, subSteps, rates);
    keepsEnergy(h, subSteps, kineticEnergy(start_));
}

void JointIsland::dropForces() {
    for (IslandHold& hold : holds_) {
        for (IslandHold::Row& row : hold.rows) { row.force = 0; }
    }
}

void JointIsland::dropTotals() {
    for (IslandHold& hold : holds_) {
        hold.reaction = {};
        hold.twist = 0;
        for (IslandHold::Row& row : hold.rows) { row.total = 0; }
    }
}

/// Whether energy tells if a step went wrong: nothing damps the bodies, and nothing drives them but constant forces.
bool JointIsland::hasAccount() const {
    return drives_.empty() && !(woundSpeed_ > 0) &&
           std::none_of(start_.begin(), start_.end(),
                        [](const IslandBody& body) { return isCarrier(body) || isDamped(body); });
}

/// As fast as what carries or draws the island leads it, J.
double JointIsland::mostLead() const {
    double speed = woundSpeed_;
    double spin = 0;
    for (const IslandHold& hold : holds_) {
        const auto add = [&](const IslandBody& body, DVec2 anchor) {
            if (!isCarrier(body)) { return; }
            spin = std::max(spin, std::fabs(body.spin));
            speed = std::max(speed, norm(body.velocity) + std::fabs(body.spin) * norm(anchor));
        };
        add(bodies_[hold.a], hold.anchorA);
        add(bodies_[hold.b], hold.anchorB);
    }
    double twice = 0;
    for (const IslandBody& body : bodies_) {
        if (body.inverseMass > 0) { twice += speed * speed / body.inverseMass; }
        if (body.inverseInertia > 0) { twice += spin * spin / body.inverseInertia; }
    }
    return kMostLead * 0.5 * twice;
}

/// Speeds that agree with joints to what stands still do so at any size.
void JointIsland::bringTo(double energy, double mostGrowth) {
    const double now = kineticEnergy(bodies_);
    if (!(now > 0)) { return; }
    const double part = std::min(std::sqrt(energy / now), mostGrowth);
    if (part == 1) { return; }
    for (IslandBody& body : bodies_) {
        if (body.column == kNoNode) { continue; }
        body.velocity = part * body.velocity;
        body.spin *= part;
    }
}

/// What drives the bodies over lengths of theirs, J: what all but stands still has no energy that a change could be
/// measured against.
double JointIsland::fallOf(double h) const {
    double fall = 0;
    for (const IslandHold& hold : holds_) {
        if (hold.kind == IslandHold::Kind::angle) { continue; }
        for (const std::uint32_t i : {hold.a, hold.b}) {
            const IslandBody& body = start_[i];  // drives may be of shorter sub-steps since
            if (body.inverseMass > 0) { fall += 2 / h * norm(body.gain) / body.inverseMass * hold.size; }
        }
    }
    return fall;
}

/// Whether the step changed no energy, where that can be told; what little it changed is undone. After one that is soft
/// what was gained is taken away; what is carried or drawn only pays then.
/// @param begun  kinetic energy that it began with, J
bool JointIsland::keepsEnergy(double h, int subSteps, double begun) {
    const bool isTold = hasAccount();
    if (!isTold && !isSoft_) { return true; }
    double work = 0;
    double flow = 0;  // without signs
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const IslandBody& body = start_[i];
        const double linear =
            body.inverseMass > 0 ? 2 / h * dot(body.gain, bodies_[i].place.position) / body.inverseMass : 0;
        const double angular =
            body.inverseInertia > 0 ? 2 / h * body.angularGain * bodies_[i].place.angle / body.inverseInertia : 0;
        work += linear + angular;
        if (body.inverseMass > 0) { flow += dot(body.gain, body.gain) * (subSteps * subSteps) / body.inverseMass; }
        flow += std::fabs(linear) + std::fabs(angular);
    }
    const double before = begun + work;
    const double after = kineticEnergy(bodies_);
    const double scale = begun + after + flow;
    const double change = std::fabs(after - before);
    const bool keeps = change <= kMostEnergyRatio * scale;
    const bool isHeld = !isFree();
    const double right = std::max(before, 0.0);  // what the gaps of joints held is no energy
    if (isHeld && isSoft_) {
        bringTo(isTold ? right : std::max(right, mostLead()), 1);
    } else if (isHeld && keeps && change > kFineEnergyRatio * (scale + fallOf(h))) {
        bringTo(right, kMostGrowth);
    }
    return keeps || !isTold;
}

/// How fast things go: turns, falls about an anchor, oscillations of what is drawn tight.
JointIsland::Rates JointIsland::ratesOf(double h) {
    Rates rates;
    tensions_.assign(bodies_.size(), 0);
    double fall = 0;
    for (const IslandHold& hold : holds_) {
        if (hold.kind == IslandHold::Kind::angle) { continue; }
        const double force = std::fabs(hold.rows[0].force) + std::fabs(hold.rows[1].force);
        const auto add = [&](std::uint32_t i, DVec2 anchor) {
            const IslandBody& body = bodies_[i];
            const double ease = easeOf(body, anchor);
            if (!(ease > 0)) { return; }
            rates.turn = std::max(rates.turn, std::fabs(body.spin));
            tensions_[i] += force * body.inverseMass * ease;
            fall = std::max(fall, 2 / h * norm(body.gain) * ease);
        };
        add(hold.a, hold.anchorA);
        add(hold.b, hold.anchorB);
    }
    double tension = 0;
    for (const double each : tensions_) { tension = std::max(tension, each); }
    rates.turn = std::max(rates.turn, std::sqrt(fall));
    rates.phase = std::sqrt(tension);
    return rates;
}

bool JointIsland::advanceExactly(double h, int subSteps, int finer, const Rates& rates) {
    dropTotals();
    goBack();
    findOpenGaps();
    duration_ = h * subSteps;
    // What the other way failed at is tried so as well.
    const bool isStiff = isTree_ && (finer > 1 || duration_ * rates.phase > kStiffPhase);
    if (!isStiff) {
        placeRows();
        factorise();
    }
    const ExactWay way{.h = h, .subSteps = subSteps, .finer = finer, .isStiff = isStiff};
    // What is damped cannot go back in time.
    const bool goesOnly = subSteps < kSubStepsReplaced || std::any_of(bodies_.begin(), bodies_.end(), isDamped);
    if (!(goesOnly ? subStepEvenly(way, rates) : subStepByCompositions(way, rates))) { return false; }
    if (isStiff) { holdTree(); }
    return true;
}

double JointIsland::mostCompositions() const {
    return std::clamp(kMostBodyCompositions / columns_, kFewestCompositions, kMostCompositions);
}

bool JointIsland::subStepExactly(const ExactWay& way, double part, double length) {
    return way.isStiff ? subStepByMiddle(part, length) : subStep(part, length);
}

bool JointIsland::subStepEvenly(const ExactWay& way, const Rates& rates) {
    const double phase = way.isStiff ? 0 : rates.phase;
    int count = way.subSteps;
    double length = way.h;
    while (length * phase > kMostPhase || length * rates.turn > kMostTurn || count < way.subSteps * way.finer) {
        if (count > mostCompositions()) { return false; }
        count *= 2;
        length *= 0.5;
        halveDrives();
    }
    for (int i = 0; i < count; ++i) {
        if (!subStepExactly(way, 1, length)) { return false; }
    }
    return true;
}

bool JointIsland::subStepByCompositions(const ExactWay& way, const Rates& rates) {
    const auto wantedFor = [&way](const Rates& now, double left) {
        const double time = way.h * left;
        const double forPhase = way.isStiff ? std::min(now.phase * time / kMostPhaseByMiddle, kMostForPhaseByMiddle)
                                            : now.phase * time / kMostPhase;
        return std::ceil(way.finer * std::max(forPhase, now.turn * time / kMostTurn));
    };
    const bool isCoarse = way.h * way.subSteps * rates.turn > kCoarseTurn;
    double left = way.subSteps;
    const int replaced = way.subSteps / kSubStepsReplaced;  // rounded down
    double compositions = std::max(wantedFor(rates, left), static_cast<double>(way.finer * replaced));
    for (double done = 0; compositions > 0; --compositions, ++done) {
        if (!(done + compositions <= way.finer * mostCompositions())) { return false; }
        const double length = left / compositions;
        for (const double part : kSuzuki) {
            if (!subStepExactly(way, part * length, way.h)) { return false; }
        }
        left -= length;
        // Lengths that follow the motion cost the symmetry in time, and are for what is lost without them.
        if (isCoarse) { compositions = std::max(wantedFor(ratesOf(way.h), left) + 1, compositions); }
    }
    return true;
}

/// Sub-steps whose forces have the direction that they end with: the motion is the nearest one that the joints allow to
/// what bodies would do without them. They lose energy, and go on where nothing else does.
/// @param more  times as many
bool JointIsland::advanceByEnds(double h, int subSteps, int more) {
    dropTotals();
    goBack();
    findOpenGaps();
    duration_ = h * subSteps;
    for (int i = 1; i < more; i *= 2) {
        halveDrives();
        h *= 0.5;
    }
    for (int i = 0; i < subSteps * more; ++i) {
        if (!subStepOfTree(1, h, ForceAt::end, more == kMostEndsFactor)) { return false; }
    }
    holdTree();
    return true;
}

void JointIsland::advanceSoftly(double h, int subSteps, const Rates& rates) {
    dropTotals();
    goBack();
    placeRows();
    factorise();
    int count = subSteps;
    while (h * rates.turn > kMostTurn && count < kMostSoftSubSteps) {
        count *= 2;
        h *= 0.5;
        halveDrives();
    }
    for (int i = 0; i < count; ++i) { subStepSoftly(h); }
}

}  // namespace swept::inline SWEPT_PRECISION
