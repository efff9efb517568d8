#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "../../broadphase/broadphase.h"
#include "../../shapes/copied_atomic.h"
#include "../../shapes/mass.h"
#include "../../shapes/raw_vector.h"
#include "../../solver/graph/island_finder.h"
#include "../contact_filter.h"
#include "../containers/pair_table.h"
#include "../containers/scratch.h"
#include "../containers/slot_pool.h"
#include "../counters.h"
#include "../events.h"
#include "../ids.h"
#include "../world_settings.h"
#include "advancing_island.h"
#include "body.h"
#include "body_glance.h"
#include "body_places.h"
#include "bullet_work.h"
#include "chain_passer.h"
#include "clash_work.h"
#include "contact.h"
#include "contact_lists.h"
#include "deck_contacts.h"
#include "effort_trial.h"
#include "energy_account.h"
#include "event_places.h"
#include "fast_islands.h"
#include "flight_work.h"
#include "held_islands.h"
#include "hemmed_pairs.h"
#include "island_errors.h"
#include "island_loads.h"
#include "island_rest.h"
#include "joint.h"
#include "joint_chains.h"
#include "landings.h"
#include "load_paths.h"
#include "pairs_of_shapes.h"
#include "parked_contacts.h"
#include "recent_steps.h"
#include "remainder_steps.h"
#include "sensor_sweeps.h"
#include "shape.h"
#include "sleeping_pairs.h"
#include "slide.h"
#include "solve_desk.h"
#include "stirs.h"
#include "touching.h"
#include "workers.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether a body may sleep, as far as its own motion tells.
enum class Tiredness : std::uint8_t { kinematic, restless, tired };

/// All data of a world. The step is a sequence of free functions over it (step.cpp); the public face is `World`.
/// Nothing in it refers to a place in it from one step to the next, so that a copy goes on like the original.
struct WorldState : Workers {
    WorldSettings settings;
    const ContactFilter* contactFilter = nullptr;  ///< the user's
    SlotPool<Body, BodyId> bodies;
    std::vector<BodyMotion> motions;  ///< by body slot
    /// By body slot: in its present solve, of what that moves or may meet; between solves `kFixedSlot`, all of them.
    std::vector<BodySlot> solverSlots;
    SlotPool<Shape, ShapeId> shapes;
    SlotPool<Joint, JointId> joints;
    std::vector<JointTie> jointTies;            ///< by joint slot
    std::vector<JointId> newJoints;             ///< made or switched on since the last step (joint_start.h)
    std::uint32_t startPause = 0;               ///< steps with new joints to come in which no balance is sought
    std::vector<std::uint32_t> loosenedChains;  ///< lowest bodies of chains that are iterated from this step on
    bool anyRestLoads = false;                  ///< of joints, maybe of such that sleep (joint_rest.h)
    std::vector<std::uint32_t> activeJoints;    ///< slots of those that hold something awake, ascending; of this step
    std::vector<std::uint32_t> awake;         ///< body slots of awake dynamic and kinematic bodies, in order of waking
    std::vector<std::uint32_t> departures;    ///< by body slot: so many of its places in `awake`, the first, are gaps
    std::size_t awakeGaps = 0;                ///< between steps: of what calls destroyed or put to sleep
    std::vector<std::uint32_t> stepped;       ///< those of the last step, before it put any to sleep
    std::vector<std::uint8_t> chainSegments;  ///< by shape slot: `Shape::isChainSegment`, while it is alive
    std::vector<MassProperties> shapeMasses;  ///< by shape slot: of those of dynamic bodies
    Scratch<std::vector<MassProperties>> massParts;  ///< scratch of `updateMass`
    std::vector<std::uint32_t> sensors;              ///< shape slots, in no order
    std::uint32_t bouncyShapes = 0;                  ///< with restitution: without any, nothing bounces
    std::uint32_t rollingShapes = 0;                 ///< with rolling resistance
    std::uint32_t chainShapes = 0;  ///< segments of chains: without any, what rides together has nothing to pay
    SensorSweeps sensorSweeps;
    /// `leastPassed` (body_measures.h) of all shapes that are or were, or less, metres.
    Real leastPassed = std::numeric_limits<Real>::infinity();
    /// Likewise of sensors, from the only one on that there was last.
    Real leastPassedOfSensors = std::numeric_limits<Real>::infinity();
    std::uint32_t kinematicBodies = 0;
    std::uint32_t fixedBodies = 0;  ///< never awake: static, or disabled
    std::uint32_t bulletBodies = 0;
    Real leastWidth = std::numeric_limits<Real>::infinity();  ///< `Body::widest` of what is or was dynamic, or less
    Real mostInverseMass = 0;                                 ///< likewise, 1/kg, or more
    Real leastInverseMass = std::numeric_limits<Real>::infinity();  ///< likewise, or less; not 0
    std::uint32_t watchedBodies = 0;  ///< with a mode of their own that has work beside sweeps (modes.h)
    std::vector<std::uint32_t>
        unmeasured;  ///< slots of bodies that lost shapes, and are not dynamic: to be measured in the next step
    std::optional<Real> thinnestWall;  ///< metres, for mode `speedLimit`; empty: to be found anew
    std::uint32_t masslessBodies = 0;  ///< dynamic bodies without mass: the step is refused while there are any

    OwnedBroadphase broadphase = makeBroadphase(BroadphaseKind::automatic);
    std::vector<std::uint32_t> proxyShapes;  ///< shape slot by proxy
    Scratch<std::vector<ProxyPair>> newPairs;
    Scratch<std::vector<NewPair>> newPairKinds;  ///< by new pair: what each is by itself
    Scratch<std::vector<ContactPair>> metPairs;  ///< of these, what met where nothing moves

    RawVector<Contact> contacts;       ///< in the order in which they began, with gaps where some ended
    std::vector<ContactProbe> probes;  ///< one for each contact that is not parked, by which it is reached
    Scratch<std::vector<ContactProbe*>> probesThere;  ///< scratch of `closeGaps`: by place of a contact
    ParkedContacts parked;
    PairsOfShapes pairsOfShapes;
    std::vector<ContactPair> candidates;  ///< pairs of dynamic bodies that were never near enough to become contacts
    Scratch<std::vector<CandidateFate>> candidateFates;  ///< by candidate, of this step
    Scratch<std::vector<ContactPair>> promoted;          ///< scratch: candidates that become contacts
    ContactLists lists;                                  ///< of this step
    std::vector<BodyGlance> glances;                     ///< by body slot
    std::vector<BodyTravel> travels;                     ///< by body slot
    Stirs stirs;                                         ///< what something heavy is about to strike (stirred.h)
    std::vector<Aabb> neededBoxes;                       ///< by proxy: `neededBox` as of this step, or more
    bool anyPieces = false;                              ///< there is, or was, a shape that is one (`Shape::isPiece`)
    Scratch<DeckContacts> deckContacts;                  ///< scratch of `dropGhostsOfDecks`
    std::vector<std::uint32_t> firstGroundContact;       ///< by body slot: see dropGhosts
    std::vector<std::uint32_t> nextGroundContact;        ///< by contact
    Scratch<std::vector<Slide>> slides;                  ///< by contact, of this step, until ghosts are dropped
    PairTable pairs;                                     ///< of shape slots that have a contact
    Scratch<std::vector<ContactPair>> droppedPairs;      ///< scratch: of these, some to be dropped together
    Scratch<RawVector<TouchingPair>> touching;           ///< in order of the probes; of this step
    HemmedPairs hemmed;                                  ///< likewise
    Landings landings;                                   ///< likewise, until the solve
    SleepingPairs sleepingPairs;
    std::vector<ChainPasser> chainPassers;     ///< of this step, in order
    std::vector<ChainPasser> crossed;          ///< in which sweeps of the last one ended, in order; none is stale
    std::vector<std::uint64_t> chainContacts;  ///< scratch of `letThrough`
    std::vector<BodyTraits> traits;            ///< by body slot, of this step
    RawVector<std::uint32_t>
        tied;  ///< slots of bodies whose role was `solved` when roles were given, in order of waking

    RawVector<std::uint32_t> tiedRoots;              ///< by place in `tied`: the root of its island
    Scratch<std::vector<std::uint32_t>> tiedJoints;  ///< of the present solve
    Scratch<RawVector<std::uint8_t>> answers;        ///< scratch of `forEachMeant`
    FastIslands fastIslands;
    Scratch<SolveDesk> mainDesk;  ///< of what no island advances: what it keeps is mostly that of the step before
    Scratch<std::deque<IslandDesk>> desks;  ///< of islands that advance, one per worker
    IslandFinder islands;
    std::vector<EnergyAccount> energyAccounts;     ///< by root: of the last solve that it was part of
    CopiedAtomic<std::uint64_t> energySolves = 0;  ///< so far: each has its number
    std::vector<Effort> efforts;                   ///< classes of the present step
    std::vector<IslandLoad> islandLoads;           ///< by root, of this step
    std::vector<BodyLoad> bodyLoads;               ///< by place in `tied`, likewise, of whom `blockLoads` leaves out
    std::vector<BlockLoad> blockLoads;             ///< likewise
    std::vector<Vec2> blows;                       ///< by body slot: which way one that strikes it pushes it, or 0
    Scratch<std::vector<IslandContacts>> islandContacts;  ///< of this step
    std::vector<Effort> tiedEfforts;                      ///< by place in `tied`: as they were given to the bodies
    JointChains jointChains;
    std::vector<std::uint8_t> islandHangs;  ///< by root: nothing in it moves (settled.cpp)
    std::vector<Pull> islandPulls;          ///< by slot: what is left of pulls and impulses of a step
    std::vector<IslandRest> islandRests;    ///< by root, of this step: of what is awake
    LoadPaths loadPaths;
    HeldIslands held;
    std::vector<IslandErrors> islandErrors;    ///< by root, of this step; only with a budget
    EffortTrial trial;                         ///< likewise
    std::vector<Tiredness> tiredness;          ///< by place in `awake`: when it was asked whether to sleep
    std::vector<std::uint8_t> islandRestless;  ///< by root: some member may not sleep yet
    std::vector<std::uint32_t> islandRing;     ///< by root: last member of the sleeping ring
    RawVector<std::uint32_t> flyers;
    std::uint32_t bullets = 0;  ///< awake ones
    std::vector<DrivenJoint> drivenJoints;
    bool anyStuck = false;  ///< any `DrivenJoint::isStuck`
    bool watched = false;   ///< this step: some body has such a mode (modes.h)
    bool anyFast = false;   ///< this step: some awake body is, or is a flyer or a bullet
    bool anyFlung = false;  ///< the solver may have moved some body as far as only a fast one moves
    Scratch<BulletWork> bulletWork;
    BodyPlaces bodyPlaces;
    Scratch<std::vector<FlightScratch>> flightScratch;  ///< one per worker
    Scratch<std::vector<ClashScratch>> clashScratch;    ///< likewise

    std::vector<ContactEvent> contactEvents;  ///< of the last step
    std::vector<ContactEvent> eventsToCome;   ///< what ended by calls since: the next step begins with them
    std::size_t eventsBetween = 0;            ///< of `contactEvents`, at the front: such ones
    EventPlaces eventPlaces;
    Scratch<std::vector<ContactEvent>> sortedEvents;  ///< scratch of `sortEvents`
    std::vector<JointBreakEvent> jointBreaks;
    std::vector<BodyId> bodiesPutBack;
    std::vector<BodyId> bodiesFellAsleep;
    std::vector<LostTimeEntry> lostTime;
    std::vector<ImpactPose> impactPoses;
    StepCounters counters;
    StageTimes stageTimes;
    bool forcesGiven = false;  ///< since the last step: some body has a force or a torque for the next one
    std::vector<std::uint32_t> pushedAsleep;  ///< slots of those that were asleep: they have it if they wake by then
    std::uint64_t steps = 0;                  ///< begun so far
    double lastDt = 0;                        ///< of the last step, s; predicts how far boxes must reach
    double closingTime = 0;     ///< s, the step or more: errors are closed as in steps of this length (step_change.h)
    double closingStretch = 1;  ///< so many times that, after steps of fewer sub-steps
    RemainderSteps remainder;
    Scratch<RemainderLoads> remainderLoads;  ///< of this step
    RecentSteps recentSteps;                 ///< as long as they vary (step_change.h)
    std::uint64_t wokenBySteps = 0;  ///< `counters.wokeUp` after the last step: what is above it was woken by calls
};

// --- asked for every body, several times a step: inline

/// Acceleration of a dynamic body: gravity and force, m/s²; angular, rad/s².
inline Vec2 accelerationOf(const WorldState& world, const Body& body) {
    return body.def.gravityScale * world.settings.gravity + body.inverseMass * body.force;
}
inline Real angularAccelerationOf(const Body& body) { return body.inverseInertia * body.torque; }
/// Approach speed up to which a body does not bounce, m/s: what gravity, or all that pulls the body, gives it in a
/// step.
inline Real bounceThreshold(const WorldState& world, const Body& body, Real dt) {
    return dt * std::max(length(world.settings.gravity), length(accelerationOf(world, body)));
}
inline std::size_t awakeCount(const WorldState& world) { return world.awake.size() - world.awakeGaps; }
/// Within a step, without a look at the body itself.
inline bool isAwakeDynamic(const WorldState& world, std::uint32_t slot) {
    return (world.traits[slot] & kIsDynamic) != 0;
}
/// Whether something that could move sleeps. (No joint holds what is held.)
inline bool anyAsleep(const WorldState& world) {
    return awakeCount(world) + world.held.bodies + world.fixedBodies < world.bodies.size();
}
/// Whether all that could move is awake, and not held either: then hardly anybody need be asked.
inline bool areAllUp(const WorldState& world) { return awakeCount(world) + world.fixedBodies == world.bodies.size(); }
/// Length of the longest path that a point of the body can take within dt, metres.
inline Real motionBound(const WorldState& world, std::uint32_t slot, Real dt) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    Real speed = length(motion.velocity);
    Real spin = std::fabs(motion.angularVelocity);
    if (body.isDynamic()) {
        speed += dt * length(accelerationOf(world, body));
        spin += dt * std::fabs(angularAccelerationOf(body));
    }
    return dt * (speed + spin * body.radius);
}
/// The motion by which contacts reach ahead of a body, metres.
inline Real reachMotion(const WorldState& world, std::uint32_t slot, Real dt) {
    return reachMotion(motionBound(world, slot, dt), world.glances[slot].isStirred, world.bodies[slot].widest);
}

}  // namespace swept::inline SWEPT_PRECISION
