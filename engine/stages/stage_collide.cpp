#include "../bodies/travel.h"
#include "../contacts/candidates.h"
#include "../contacts/chain_passage.h"
#include "../contacts/contact_fetch.h"
#include "../contacts/contact_lists.h"
#include "../contacts/contact_making.h"
#include "../contacts/contact_tests.h"
#include "../contacts/near_update.h"
#include "../contacts/new_pairs.h"
#include "../contacts/parked_contacts.h"
#include "../crew/beside.h"
#include "../modes/modes.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block: enough work, some microseconds, to pay for handing it over.
constexpr std::size_t kNoteGrain = 16;

/// So that the contacts of a body need not ask it one by one. @param haveContacts  else a bound of its motion is all
/// that is asked
void noteSome(WorldState& world, std::span<const std::uint32_t> awake, bool haveContacts) {
    for (std::size_t i = 0; i < awake.size(); ++i) {
        fetchAhead(world, awake.subspan(i));
        const std::uint32_t slot = awake[i];
        world.glances[slot].motion = motionBound(world, slot, static_cast<Real>(world.lastDt));
        if (haveContacts) { noteMotion(world, slot); }
    }
}

/// After the motions of all that is awake.
void noteFreeBullets(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        BodyGlance& glance = world.glances[slot];
        if (isFastFreeBullet(world, world.bodies[slot], glance.motion)) { glance.isFast = true; }
    }
}

/// Of all that is awake, while one worker takes up the new pairs. What these release is awake then, too.
void noteMotions(WorldState& world, bool haveContacts) {
    const std::span<const std::uint32_t> awake = world.awake;
    const auto note = [&world, awake, haveContacts](std::size_t begin, std::size_t end) {
        noteSome(world, awake.subspan(begin, end - begin), haveContacts);
    };
    const std::size_t before = awake.size();
    runBeside(
        *world.loops, [&world] { addPairs(world); }, before, kNoteGrain, note);
    releaseMet(world);
    noteSome(world, std::span(world.awake).subspan(before), haveContacts);
    if (haveContacts && world.bulletBodies > 0) { noteFreeBullets(world); }
}

}  // namespace

void collideContacts(WorldState& world) {
    const ParkedContacts& parked = world.parked;
    const bool areAnyParked = parked.probes.size() > 0 || parked.candidates.size() > 0;
    noteMotions(world, areAnyParked || hasContacts(world) || !world.newPairs.empty());
    unparkContacts(world);
    parkContacts(world);
    closeGaps(world);
    world.touching.clear();
    if (!hasContacts(world)) {
        world.lists.clear();
        world.chainPassers.clear();
        world.crossed.clear();
        return;
    }
    promoteCandidates(world);
    listContacts(world);
    updateNear(world);
    letThrough(world);  // here, since others forget where the last step began while contacts are noticed
}

}  // namespace swept::inline SWEPT_PRECISION
