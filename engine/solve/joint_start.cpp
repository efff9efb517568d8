#include "joint_start.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "../../solver/direct/start_balance.h"
#include "../contacts/contact_tests.h"
#include "../containers/island_items.h"
#include "../state/profile.h"
#include "../state/tolerances.h"
#include "joint_builder.h"
#include "joint_rest.h"
#include "joint_results.h"
#include "tied_bodies.h"
#include "tied_contacts.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies of an island: beyond that a search takes too long for a step.
constexpr std::size_t kMostStartBodies = 2048;
/// So many bodies cost a step in which nothing is sought (900 bricks take 8 ms): who adds a brick in each step to what
/// is large pays for that now and then.
constexpr std::size_t kBodiesOfPause = 128;

struct StartMarks {
    std::vector<std::uint8_t> isMeant;  ///< by root: a joint of it is new
    std::vector<std::uint8_t> isHeld;   ///< by root: by what is not dynamic
};

std::uint32_t dynamicBodyOf(const WorldState& world, std::uint32_t joint) {
    for (const std::uint32_t slot : world.joints[joint].allBodies()) {
        if (world.bodies[slot].isDynamic() && world.bodies[slot].role == BodyRole::solved) { return slot; }
    }
    return kNoIndex;
}

bool isAnchor(const WorldState& world, std::uint32_t joint) {
    const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
    return std::any_of(bodies.begin(), bodies.end(),
                       [&world](std::uint32_t slot) { return !world.bodies[slot].isDynamic(); });
}

StartMarks markIslands(WorldState& world) {
    StartMarks marks;
    marks.isMeant.assign(world.bodies.slotCount(), 0);
    marks.isHeld.assign(world.bodies.slotCount(), 0);
    for (const JointId id : world.newJoints) {
        if (world.joints.find(id) == nullptr || !world.jointTies[id.index].holds) { continue; }
        if (world.joints[id.index].type() > JointType::weld) { continue; }
        const std::uint32_t body = dynamicBodyOf(world, id.index);
        if (body != kNoIndex) { marks.isMeant[world.islands.find(body)] = 1; }
    }
    for (const std::uint32_t joint : world.activeJoints) {
        const std::uint32_t body = dynamicBodyOf(world, joint);
        if (body != kNoIndex && isAnchor(world, joint)) { marks.isHeld[world.islands.find(body)] = 1; }
    }
    for (const TouchingPair& pair : world.touching) {
        if (!pair.areDynamic() && isTied(world, pair)) { marks.isHeld[world.islands.find(pair.dynamicBody())] = 1; }
    }
    return marks;
}

/// Contacts within what joints hold together do not carry yet; points that gape by less than what counts as touching
/// may.
void leaveOut(WorldState& world, SolverBatch& batch) {
    IslandFinder& chains = world.jointChains.finder;
    std::erase_if(batch.contacts, [&](const ContactConstraint& constraint) {
        const Contact& contact = world.contacts[constraint.source];
        return contact.dynamicA && contact.dynamicB && chains.find(contact.bodyA) == chains.find(contact.bodyB);
    });
    for (ContactConstraint& constraint : batch.contacts) {
        const Real touching = kBeginRatio * world.contacts[constraint.source].extent;
        for (ContactConstraintPoint& point : constraint.points) {
            if (point.baseSeparation <= touching) { point.baseSeparation = std::min(point.baseSeparation, Real(0)); }
        }
    }
}

void takeContacts(WorldState& world, const SolverBatch& batch, Real scale) {
    for (const ContactConstraint& constraint : batch.contacts) {
        Contact& contact = world.contacts[constraint.source];
        for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
            contact.normalImpulse[k] = constraint.points[k].normalImpulse / scale;
            contact.tangentImpulse[k] = constraint.points[k].tangentImpulse / scale;
        }
    }
}

void startIsland(WorldState& world, const TiedGroup& group, double dt) {
    SolverBatch& batch = group.desk.batch;
    const int usual = subStepsOf(world.settings);
    const int subSteps = subStepsFor(group.effort, usual);
    const auto step = static_cast<Real>(dt);
    const Real h = step / static_cast<Real>(subSteps);
    const Real scale = static_cast<Real>(usual) / static_cast<Real>(subSteps);
    batch.clear();
    giveSlots(world, group, step);
    setBodies(world, group, h, [] {});
    const StepPart whole{.length = dt, .dt = dt, .subSteps = subSteps};
    const SolveTimes times(whole, h);
    for (const std::uint32_t joint : group.joints) { addConstraint(batch, world, joint, times); }
    TiedContacts contacts(world, group, whole, h, scale);
    contacts.addConstraints();
    leaveOut(world, batch);
    StartBalance balance;
    if (balance.find(batch)) {
        addRestLoads(world, batch, h);
        readConstraints(batch, world, step);
        takeContacts(world, batch, scale);
    }
    for (const std::uint32_t slot : group.desk.bodies) { world.solverSlots[slot] = kFixedSlot; }
    batch.clear();
}

/// What moves is in no balance.
bool areAtRest(const WorldState& world, std::span<const std::uint32_t> bodies) {
    return std::none_of(bodies.begin(), bodies.end(),
                        [&world](std::uint32_t slot) { return isOnTheMove(world, slot); });
}

/// What the islands that are sought consist of, by their numbers: one look at all that there is, however many they are.
struct StartLists {
    std::vector<std::uint32_t> roots;  ///< by number: slots
    IslandItems bodies;                ///< slots
    IslandItems joints;                ///< slots
    IslandItems touching;              ///< places in `WorldState::touching`
};

StartLists listIslands(WorldState& world, const StartMarks& marks) {
    StartLists lists;
    std::vector<std::uint32_t> numbers(world.bodies.slotCount(), kNoIndex);
    for (const std::uint32_t slot : world.tied) {
        if (marks.isMeant[slot] == 0 || marks.isHeld[slot] == 0) { continue; }
        const Effort effort = world.bodies[slot].effort;
        if (effort.direct != DirectScope::none || effort.isSettled) { continue; }
        numbers[slot] = static_cast<std::uint32_t>(lists.roots.size());
        lists.roots.push_back(slot);
    }
    const auto numberOf = [&world, &numbers](std::uint32_t slot) { return numbers[world.islands.find(slot)]; };
    const auto add = [](IslandItems& items, std::uint32_t number, std::uint32_t item) {
        if (number != kNoIndex) { items.add(number, item); }
    };
    for (const std::uint32_t slot : world.tied) { add(lists.bodies, numberOf(slot), slot); }
    for (const std::uint32_t joint : world.activeJoints) {
        const std::uint32_t body = dynamicBodyOf(world, joint);
        if (body != kNoIndex) { add(lists.joints, numberOf(body), joint); }
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(world.touching.size()); ++i) {
        const TouchingPair& pair = world.touching[i];
        const std::uint32_t ofA = pair.dynamicA ? numberOf(pair.bodyA) : kNoIndex;
        const std::uint32_t ofB = pair.dynamicB ? numberOf(pair.bodyB) : kNoIndex;
        add(lists.touching, ofA, i);
        if (ofB != ofA) { add(lists.touching, ofB, i); }
    }
    for (IslandItems* items : {&lists.bodies, &lists.joints, &lists.touching}) { items->sort(lists.roots.size()); }
    return lists;
}

/// @return bodies of the island, or 0 when nothing was sought
std::size_t startIslandOf(WorldState& world, const StartLists& lists, std::size_t number, double dt) {
    const std::span<const std::uint32_t> bodies = lists.bodies.of(number);
    if (bodies.size() > kMostStartBodies || !areAtRest(world, bodies)) { return 0; }
    std::vector<TouchingPair> touching;
    for (const std::uint32_t i : lists.touching.of(number)) { touching.push_back(world.touching[i]); }
    startIsland(world,
                {.desk = world.mainDesk,
                 .effort = world.bodies[lists.roots[number]].effort,
                 .bodies = bodies,
                 .contacts = world.contacts,
                 .touching = touching,
                 .joints = lists.joints.of(number)},
                dt);
    return bodies.size();
}

}  // namespace

void startJoints(WorldState& world, double dt) {
    if (world.startPause > 0) {
        --world.startPause;
        return;
    }
    const StartMarks marks = markIslands(world);
    world.newJoints.clear();
    const StartLists lists = listIslands(world, marks);
    world.mainDesk.loops = world.loops;
    std::size_t bodies = 0;
    for (std::size_t i = 0; i < lists.roots.size(); ++i) { bodies += startIslandOf(world, lists, i, dt); }
    world.startPause = static_cast<std::uint32_t>(bodies / kBodiesOfPause);
}

}  // namespace swept::inline SWEPT_PRECISION
