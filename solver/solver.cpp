#include "solver.h"

#include <span>
#include <type_traits>
#include <utility>

#include "free_motion.h"
#include "halves.h"
#include "solve_preparation.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Joints, blocks of contacts and contacts on their own per part of a parallel loop.
constexpr std::size_t kConstraintGrain = 4;
/// A solve is shared when such a one stands in a colour of so many, in the mean; but colours of few are never. What one
/// worker wrote and another reads has to come from cache to cache, which takes as long as solving it.
constexpr std::size_t kFewestPerColour = 32;
constexpr std::size_t kFewestOfColour = 16;
/// Contacts that blocks are filled with from several threads, some tens of nanoseconds each.
constexpr std::size_t kFewestToFill = 512;
/// Over what is settled: they take out the rounding of impulses.
constexpr int kSettledPasses = 1;
/// Of contacts that bounce in turn: as many where some are lively.
constexpr int kTurns = 4;

template <class Constraint>
ColourRange rangeOf(const std::vector<Constraint>&, const ConstraintGraph& graph, int colour) {
    return graph.range<Constraint>(colour);
}

template <class Constraint>
std::size_t countOf(const std::vector<Constraint>& joints, const ConstraintGraph& graph, int colour) {
    const ColourRange range = rangeOf(joints, graph, colour);
    return joints.empty() ? 0 : range.end - range.begin;
}

SolverBodies bodiesOf(SolverBatch& batch) { return {batch.states, batch.inertias}; }

}  // namespace

/// The joints of a colour, kind by kind, as far as they are inside of the cut.
/// @param ofBlocks  called with the blocks of joints of a kind that has them, where there are any
/// @param ofJoints  called with some joints of any other kind
template <class OfBlocks, class OfJoints>
void Solver::forEachJointOf(SolverBatch& batch, int colour, RangeCut& cut, const OfBlocks& ofBlocks,
                            const OfJoints& ofJoints) {
    batch.forEachJointKind([&](auto& joints) {
        if constexpr (standInBlocks<std::remove_cvref_t<decltype(joints)>>()) {
            auto& blocks = blocksOf(joints);
            if (blocks.areIn(batch)) { ofBlocks(blocks); }
        } else if (!joints.empty()) {
            ofJoints(cut.next(joints, rangeOf(joints, graph_, colour)));
        }
    });
}

template <bool kJoints>
void Solver::prepare(SolverBatch& batch, const SolverSettings& settings, bool isColoured) {
    if (needsContactsPrepared(batch, settings)) {
        for (ContactConstraint& contact : batch.contacts) { prepareContact(contact, batch.inertias); }
    }
    if constexpr (kJoints) {
        if (!isColoured) { graph_.colour(batch); }
        prepareJoints(batch);
    } else if (!isColoured) {
        graph_.colourContacts(batch);
    }
    // What is solved all at once is summed up in the order of the array.
    if (looksAtContacts(settings.direct)) { graph_.sortContacts(batch); }
    if (batch.store == nullptr) { listBouncing(batch, settings); }
}

/// Colours in their order. Those that hold nothing but contacts on their own are gone through at once: a hub with fifty
/// contacts has forty colours of one contact each.
template <bool kJoints>
void Solver::listRuns(SolverBatch& batch) {
    runs_.clear();
    bool mayJoin = false;  // the last one may be gone on with
    for (const int colour : graph_.activeColours()) {
        const bool isPlain = partsOf<kJoints>(batch, colour) == contacts_.countOf(colour);
        if (mayJoin && isPlain && contacts_.join(runs_.back().colour, colour)) {
            runs_.back().inOrder = true;
            continue;
        }
        runs_.push_back({colour, colour == kOverflowColour});
        mayJoin = isPlain;
    }
    for (Run& run : runs_) { run.parts = partsOf<kJoints>(batch, run.colour); }
}

/// Where one worker solves contacts alone: to find out for each pass what a colour holds takes as long as to solve a
/// few. @pre it is known who solves
template <bool kJoints>
void Solver::listContacts() {
    isListed_ = !kJoints && !areJointed_ && loops_->workerCount() <= 1;
    if (!isListed_) { return; }
    contacts_.clearList();
    for (const Run& run : runs_) { contacts_.list(run.colour); }
}

/// All that the colours hold, one colour after the other; of each its joints first and one list after the other, in
/// ranges that any worker may take: no two share a movable body.
template <class Visit>
void Solver::forEachRun(const Visit& visit) {
    for (const Run& run : runs_) {
        const std::size_t count = run.parts;
        if (run.inOrder || count < fewestToShare_) {
            visit(run.colour, RangeCut(0, count));
            continue;
        }
        // Joints are in no such order.
        const std::size_t middle = count == contacts_.countOf(run.colour) ? contacts_.middleOf(run.colour) : count / 2;
        runInHalves(*loops_, middle, count, kConstraintGrain,
                    [&](std::size_t begin, std::size_t end) { visit(run.colour, RangeCut(begin, end)); });
    }
}

/// Parts of a colour: what `forEachRun` counts through.
template <bool kJoints>
std::size_t Solver::partsOf(SolverBatch& batch, int colour) {
    std::size_t count = contacts_.countOf(colour);
    if constexpr (kJoints) {
        batch.forEachJointKind([&](auto& joints) {
            if constexpr (standInBlocks<std::remove_cvref_t<decltype(joints)>>()) {
                auto& blocks = blocksOf(joints);
                count += blocks.areIn(batch) ? blocks.countOf(colour) : 0;
            } else {
                count += countOf(joints, graph_, colour);
            }
        });
    }
    return count;
}

bool Solver::isWorthSharing() const {
    std::size_t all = 0;
    std::size_t companions = 0;
    for (const Run& run : runs_) {
        all += run.parts;
        companions += run.parts * run.parts;
    }
    return companions >= kFewestPerColour * all;
}

template <bool kJoints>
void Solver::warmStart(SolverBatch& batch, bool hasMoved) {
    forEachRun([&](int colour, RangeCut cut) {
        if constexpr (kJoints) {
            forEachJointOf(
                batch, colour, cut, [&](auto& blocks) { blocks.warmStart(batch, colour, cut, hasMoved); },
                [bodies = bodiesOf(batch)](auto joints) { swept::warmStart(joints, bodies); });
        }
        contacts_.warmStart(batch, colour, cut);
    });
}

template <bool kJoints>
void Solver::solveColours(SolverBatch& batch, const ContactPass& pass) {
    if (isListed_) { return contacts_.solveListed(batch, pass); }
    forEachRun([&](int colour, RangeCut cut) {
        if constexpr (kJoints) {
            forEachJointOf(
                batch, colour, cut, [&](auto& blocks) { blocks.solve(batch, colour, cut, pass); },
                [&pass, bodies = bodiesOf(batch)](auto joints) { swept::solve(joints, bodies, pass.h, pass.useBias); });
        }
        if (!areJointed_) { contacts_.solve(batch, colour, cut, pass); }
    });
    if (areJointed_) { direct_.solveJointed(batch, pass); }
}

/// @pre drives of a whole sub-step, or of half a one, twice
template <bool kJoints>
void Solver::subStepIteratively(SolverBatch& batch, const SolverSettings& settings, Real h, bool isFirst,
                                SolveReport& report) {
    const bool relaxes = settings.relaxPasses > 0;
    if (isRepeated_) {
        report.speedsLimited += integrateAndRepeat(batch, settings.maxSpeed, isFirst);
    } else {
        report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
        if (settings.direct != DirectScope::none) {
            report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
        }
    }
    if (isFirst || !isRepeated_) { warmStart<kJoints>(batch, isFirst || !relaxes); }
    solveColours<kJoints>(batch, {.h = h, .useBias = true, .hasMoved = isFirst || !relaxes, .isLast = !relaxes});
    integratePositions(batch, h);
    for (int pass = 0; pass < settings.relaxPasses; ++pass) {
        solveColours<kJoints>(batch, {.h = h, .hasMoved = pass == 0, .isLast = pass + 1 == settings.relaxPasses});
    }
    contacts_.addUpBouncing(batch);
}

/// Nothing moves that a pass would have to follow: gaps and overlaps stay what they were found to be.
void Solver::holdSettled(SolverBatch& batch, const SolverSettings& settings, SolveReport& report) {
    report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
    warmStart<false>(batch, false);
    for (int pass = 0; pass < kSettledPasses; ++pass) {
        solveColours<false>(batch, {.h = settings.dt, .hasMoved = false, .isLast = pass + 1 == kSettledPasses});
    }
    integratePositions(batch, settings.dt);
    contacts_.addUpBouncing(batch);
}

/// RATTLE (Andersen 1983): half of the drive, velocities such that the motion ends where the constraints hold, the
/// motion, the other half, velocities that keep them. Second order and symplectic, so that a pendulum keeps its energy.
/// Iteration comes after each direct solve, for what that leaves out.
///
/// Where contacts take turns with joints, all of the drive comes before the motion: what rests must stay as it is when
/// each had a turn, from the impulses of the sub-step before. Those are for all of the drive. Against half of it they
/// would push bodies apart, and one turn does not share out what is to be taken back: a crate in fingers on a heavy
/// head climbed by 1.8 mm/s. (Of joints alone the motion is the same either way: between two motions it is the same
/// drive.)
template <bool kJoints>
void Solver::subStepDirectly(SolverBatch& batch, const SolverSettings& settings, Real h, SolveReport& report) {
    const bool isInTurns = takesTurns(settings.direct, !batch.contacts.empty());
    report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
    if (isInTurns) { report.speedsLimited += integrateVelocities(batch, settings.maxSpeed); }
    direct_.noteMotions(batch);
    warmStart<kJoints>(batch, true);
    direct_.solve(batch, h, true, report.direct);
    solveColours<kJoints>(batch, {.h = h, .useBias = true, .isLast = settings.relaxPasses == 0});
    if constexpr (kJoints) { direct_.holdAgain(batch, report.direct); }
    integratePositions(batch, h);
    if (!isInTurns) { report.speedsLimited += integrateVelocities(batch, settings.maxSpeed); }
    direct_.solve(batch, h, false, report.direct);
    for (int pass = 0; pass < settings.relaxPasses; ++pass) {
        solveColours<kJoints>(batch, {.h = h, .isLast = pass + 1 == settings.relaxPasses});
    }
    contacts_.addUpBouncing(batch);
}

/// The same where contacts are solved all at once, too: iteration has its way only where that fails.
template <bool kJoints>
void Solver::subStepOfContacts(SolverBatch& batch, const SolverSettings& settings, Real h, bool isLast,
                               SolveReport& report) {
    report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
    direct_.beginFirstHalf();
    if (!direct_.solve(batch, h, true, report.direct)) {
        warmStart<kJoints>(batch, true);
        solveColours<kJoints>(batch, {.h = h, .useBias = true});
    }
    integratePositions(batch, h);
    direct_.project(batch, h, isLast, report.direct);
    report.speedsLimited += integrateVelocities(batch, settings.maxSpeed);
    direct_.beginSecondHalf();
    if (!direct_.solve(batch, h, false, report.direct)) {
        warmStart<kJoints>(batch, true);
        for (int pass = 0; pass < settings.relaxPasses; ++pass) { solveColours<kJoints>(batch, {.h = h}); }
    }
    direct_.addHalves();
    addUpImpulses(batch.contacts);
}

void Solver::bounceInTurn(SolverBatch& batch, int turns, const ContactPass& pass) {
    for (int turn = 0; turn < turns; ++turn) {
        ContactPass ofTurn = pass;
        ofTurn.hasMoved = pass.hasMoved && turn == 0;
        ofTurn.leastRestitution = turn == 0 ? Real(0) : kLivelyRestitution;
        forEachRun([&](int colour, RangeCut cut) { contacts_.bounce(batch, colour, cut, ofTurn); });
    }
}

template <bool kJoints, bool kBounces>
void Solver::runSubSteps(SolverBatch& batch, const SolverSettings& settings, SolveReport& report) {
    const Real h = settings.dt / static_cast<Real>(settings.subSteps);
    const bool isIterated = settings.direct == DirectScope::none;
    isRepeated_ = !kJoints && !kBounces && isIterated && !settings.bouncesInTurn;
    const bool isLively = settings.bouncesInTurn && contacts_.mostRestitution(batch) > kLivelyRestitution;
    const int turns = settings.bouncesInTurn ? (isLively ? kTurns : 1) : 0;
    for (int subStep = 0; subStep < settings.subSteps; ++subStep) {
        // Bounces come before this sub-step's gravity: reflected together with the speed, its gain would count twice,
        // and a ball would rise by 2·speed·h with every bounce.
        if constexpr (kBounces) {
            const ImpactRule bounce{.restitutionThreshold = settings.restitutionThreshold,
                                    .horizon = h,
                                    .isCoarse = settings.coarseImpacts};
            report.bounceRounds += reflectImpacts(bouncing_, bodiesOf(batch), bounce, kMaxBounceRounds, impactScratch_);
        }
        if (turns > 0) {
            bounceInTurn(batch, turns,
                         {.h = h,
                          .hasMoved = !settings.settled && (subStep == 0 || settings.relaxPasses == 0),
                          .bounceSpeed = settings.restitutionThreshold});
            report.bounceRounds += turns;
        }
        if (settings.settled) {
            holdSettled(batch, settings, report);
        } else if (report.isDirect && settings.direct == DirectScope::all) {
            subStepOfContacts<kJoints>(batch, settings, h, subStep + 1 == settings.subSteps, report);
        } else if (report.isDirect) {
            subStepDirectly<kJoints>(batch, settings, h, report);
        } else {
            subStepIteratively<kJoints>(batch, settings, h, subStep == 0, report);
        }
        if constexpr (kJoints) {
            batch.forEachJointKind([&](auto& joints) {
                if constexpr (standInBlocks<std::remove_cvref_t<decltype(joints)>>()) {
                    blocksOf(joints).addUpRest(batch);
                } else {
                    addUpReactions(std::span(joints));
                }
            });
        }
    }
}

void Solver::buildJointBlocks(SolverBatch& batch, bool isWide, TaskSystem& ofManyHinges) {
    hinges_.build(batch, graph_, isWide, ofManyHinges);
    forEachPlainBlocks([&](auto& blocks) { blocks.build(batch, graph_, isWide); });
}

template <bool kJoints>
SolveReport Solver::solveWith(SolverBatch& batch, const SolverSettings& settings, bool isColoured, TaskSystem& loops) {
    prepare<kJoints>(batch, settings, isColoured);
    move_ = settings.wide ? motionKernel() : nullptr;
    if (move_ == nullptr) { move_ = moveBodies; }
    SolveReport report{.colours = static_cast<int>(graph_.activeColours().size())};
    direct_.setLeastClosing(settings.leastClosing);
    report.isDirect =
        settings.direct != DirectScope::none && direct_.prepare(batch, settings.direct, settings.hasManyBodies);
    areJointed_ = report.isDirect && settings.direct == DirectScope::jointed;
    const bool isHeld = report.isDirect && !direct_.isIdle();
    if (isHeld) {
        makeContactsRigid(batch, settings.direct);
        if constexpr (kJoints) { makeJointsRigid(batch); }
    }
    const bool isAtOnce = loops.startSeconds() < TaskSystem::kAtOnce;
    const bool hasMany = isAtOnce || graph_.contactColours().size() >= kFewestToFill;
    TaskSystem& ofMany = hasMany ? loops : serial_;
    contacts_.build(batch, graph_,
                    {.wide = settings.wide && !(isHeld && looksAtContacts(settings.direct)),
                     .prepared = needsContactsPrepared(batch, settings)},
                    ofMany);
    report.contactBlocks = contacts_.blockCount();
    if (batch.store != nullptr) { listBouncing(batch, settings); }
    const bool hasManyHinges = isAtOnce || batch.hingeLinks.size() >= kFewestToFill;
    TaskSystem& ofManyHinges = hasManyHinges ? loops : serial_;
    if constexpr (kJoints) {
        buildJointBlocks(batch, settings.wide && !isHeld, ofManyHinges);
        countJointBlocks(report);
    }
    listRuns<kJoints>(batch);
    const bool isShared = isAtOnce || isWorthSharing();
    loops_ = isShared ? &loops : &serial_;
    fewestToShare_ = isAtOnce ? 0 : kFewestOfColour;
    listContacts<kJoints>();
    if (bouncing_.empty()) {
        runSubSteps<kJoints, false>(batch, settings, report);
    } else {
        runSubSteps<kJoints, true>(batch, settings, report);
    }
    if (isMet_ && areJointed_) { direct_.forgetBlows(); }
    report.isDirect = isHeld;
    contacts_.readBack(batch, ofMany);
    if constexpr (kJoints) {
        hinges_.readBack(batch, ofManyHinges);
        forEachPlainBlocks([&batch](auto& blocks) { blocks.readBack(batch); });
    }
    return report;
}

/// Islands whose drives do not go on smoothly are left to sub-steps.
SolveReport Solver::solveDriven(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops) {
    SolveReport report = solveIslands(batch, settings, loops);
    if (!islands_.anyUndone()) { return report; }
    SolverBatch& undone = undone_.take(batch, islands_);
    report.add(solveWith<true>(undone, settings, false, loops), settings.subSteps, undone.states.size() - 1);
    undone_.giveBack(batch);
    return report;
}

void Solver::colourAhead(SolverBatch& batch, bool onlyContacts, std::span<const BodySlot> standing) {
    graph_.colourAhead(batch, onlyContacts, standing);
    isColoured_ = true;
}

SolveReport Solver::solve(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops) {
    const bool isColoured = std::exchange(isColoured_, false);
    isMet_ = false;
    SolverSettings used = settings;
    if (settings.direct == DirectScope::islandsWithDrives) {
        used.direct = settings.left;
        if (batch.contacts.empty()) { return solveDriven(batch, used, loops); }
    }
    if (settings.direct == DirectScope::islands) {
        if (batch.contacts.empty()) { return solveIslands(batch, settings, loops); }
        // Parts of a step may meet contacts that the step did not begin with.
        isMet_ = mayBeJointed(batch);
        if (isMet_) { used.direct = DirectScope::jointed; }
    }
    return settings.joints ? solveWith<true>(batch, used, isColoured, loops)
                           : solveWith<false>(batch, used, isColoured, loops);
}

}  // namespace swept::inline SWEPT_PRECISION
