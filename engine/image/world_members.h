#pragma once

#include <type_traits>

#include "../state/world_state.h"
#include "body_members.h"
#include "contact_members.h"
#include "joint_members.h"
#include "members.h"

/// What of a world is written: all that goes on from one step to the next, or is told between them. Left out is what a
/// step makes anew before it asks for it, and what only spares it work; a new member has to be put on one side or the
/// other, or it does not compile. (WorldImage.* would differ if something were on the wrong side.)

namespace swept::inline SWEPT_PRECISION {

template <MaybeConst<JointChains> T>
constexpr auto allMembers(T& chains) {
    static_assert(areAllListed<JointChains>(12));
    return listed(chains.areCurrent, chains.tieSleepers, chains.isAnyLoose, chains.isAnyAdrift, chains.mayAnyLend,
                  chains.list, leftOut(chains.before), chains.members, chains.bullets, chains.finder, chains.places,
                  leftOut(chains.thinLoops));
}

template <MaybeConst<ParkedContacts> T>
constexpr auto allMembers(T& parked) {
    static_assert(areAllListed<ParkedContacts>(8));
    return listed(parked.probes, parked.candidates, parked.impulses, parked.touching, parked.rested, parked.woken,
                  leftOut(parked.isUp), leftOut(parked.places));
}

/// Lists are made when somebody asks.
template <MaybeConst<PairsOfShapes> T>
constexpr auto allMembers(T& pairs) {
    return listed(leftOut(pairs.scans), leftOut(pairs.state), pairs.gaps, leftOut(pairs.begins), leftOut(pairs.places),
                  leftOut(pairs.found));
}

template <MaybeConst<Stirs> T>
constexpr auto allMembers(T& stirs) {
    static_assert(areAllListed<Stirs>(6));
    return listed(stirs.bodies, leftOut(stirs.strikers), leftOut(stirs.moves), leftOut(stirs.met), leftOut(stirs.noted),
                  leftOut(stirs.blows));
}

/// The contact filter is the host's, as the task system is; the broadphase is written by its kind (world_image.cpp).
template <MaybeConst<WorldState> T>
constexpr auto allMembers(T& w) {
    const auto all = listed(
        w.settings, leftOut(w.contactFilter), w.bodies, w.motions, leftOut(w.solverSlots), w.shapes, w.awake,
        w.departures, w.awakeGaps, w.stepped, w.chainSegments, w.shapeMasses, leftOut(w.massParts), w.sensors,
        w.bouncyShapes, w.rollingShapes, w.chainShapes, leftOut(w.sensorSweeps), w.leastPassed, w.leastPassedOfSensors,
        w.kinematicBodies, w.fixedBodies, w.bulletBodies, w.leastWidth, w.mostInverseMass, w.leastInverseMass,
        w.watchedBodies, w.unmeasured, w.thinnestWall, w.masslessBodies,
        // Joints.
        w.joints, w.jointTies, w.newJoints, w.startPause, w.loosenedChains, w.anyRestLoads, w.activeJoints,
        w.jointChains, w.drivenJoints, w.anyStuck,
        // Contacts.
        leftOut(w.broadphase), w.proxyShapes, leftOut(w.newPairs), leftOut(w.newPairKinds), leftOut(w.metPairs),
        w.contacts, w.probes, leftOut(w.probesThere), w.parked, w.pairsOfShapes, w.candidates,
        leftOut(w.candidateFates), leftOut(w.promoted), leftOut(w.lists), w.glances, w.travels, w.stirs, w.neededBoxes,
        w.anyPieces, leftOut(w.deckContacts), leftOut(w.firstGroundContact), leftOut(w.nextGroundContact),
        leftOut(w.slides), w.pairs, leftOut(w.droppedPairs), leftOut(w.touching), leftOut(w.hemmed),
        leftOut(w.landings), leftOut(w.sleepingPairs), leftOut(w.chainPassers), w.crossed, leftOut(w.chainContacts),
        // Islands, and what moves.
        leftOut(w.traits), leftOut(w.tied), leftOut(w.tiedRoots), leftOut(w.tiedJoints), leftOut(w.answers),
        leftOut(w.fastIslands), leftOut(w.mainDesk), leftOut(w.desks), leftOut(w.islands), leftOut(w.energyAccounts),
        w.energySolves, leftOut(w.efforts), leftOut(w.islandLoads), leftOut(w.bodyLoads), leftOut(w.blockLoads),
        leftOut(w.blows), leftOut(w.islandContacts), leftOut(w.tiedEfforts), leftOut(w.islandHangs),
        leftOut(w.islandPulls), leftOut(w.islandRests), leftOut(w.loadPaths), w.held, leftOut(w.islandErrors),
        leftOut(w.trial), leftOut(w.tiredness), leftOut(w.islandRestless), leftOut(w.islandRing), leftOut(w.flyers),
        w.bullets, w.watched, w.anyFast, w.anyFlung, leftOut(w.bulletWork), leftOut(w.bodyPlaces),
        leftOut(w.flightScratch), leftOut(w.clashScratch),
        // What the last step did, and when it was.
        w.contactEvents, w.eventsToCome, w.eventsBetween, leftOut(w.eventPlaces), leftOut(w.sortedEvents),
        w.jointBreaks, w.bodiesPutBack, w.bodiesFellAsleep, w.lostTime, w.impactPoses, w.counters, w.stageTimes,
        w.forcesGiven, w.pushedAsleep, w.steps, w.lastDt, w.closingTime, w.closingStretch, w.remainder,
        leftOut(w.remainderLoads), w.recentSteps, w.wokenBySteps);
    static_assert(areAllListed<WorldState>(1 + decltype(all)::kCount), "the one more is the base, `Workers`");
    return all;
}

}  // namespace swept::inline SWEPT_PRECISION
