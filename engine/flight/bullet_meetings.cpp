#include "bullet_meetings.h"

#include <algorithm>
#include <cmath>

#include "../state/world_state.h"
#include "flight_state.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of heaps: the next one is the first.
bool isLater(const BulletMeeting& a, const BulletMeeting& b) { return a.isAfter(b); }

BulletMeeting popMeeting(BulletWork& work) {
    std::pop_heap(work.meetings.begin(), work.meetings.end(), isLater);
    const BulletMeeting meeting = work.meetings.back();
    work.meetings.pop_back();
    return meeting;
}

/// Meetings of paths that changed since. @return whether there is one left; then the first one will happen
bool dropStale(BulletWork& work) {
    for (; !work.meetings.empty(); popMeeting(work)) {
        const BulletMeeting& meeting = work.meetings.front();
        const bool isFirstSame = work.partners[work.indices[meeting.first]].changes == meeting.firstChanges;
        const bool isSecondSame =
            !meeting.isPair() || work.partners[work.indices[meeting.second]].changes == meeting.secondChanges;
        if (isFirstSame && isSecondSame) { return true; }
    }
    return false;
}

/// A sweep meets within a tolerance to either side of its target, and what is three of them above it is in reach of the
/// impact.
constexpr double kTolerancesOfMoment = 3;
/// What all but rides on each other takes long for a tolerance. Such meetings come one after the other.
constexpr double kLongestMoment = 1.0 / 1024;
/// Meetings of a moment that are looked through: where a crowd chatters there may be thousands.
constexpr std::size_t kMostAside = 64;

/// How long after a meeting another one of the same two, as far as its sweep tells, would be the same, seconds.
double momentOf(const WorldState& world, const BulletMeeting& pair) {
    const BulletWork& work = world.bulletWork;
    const BulletPartner& first = work.partners[work.indices[pair.first]];
    const BulletPartner& second = work.partners[work.indices[pair.second]];
    const auto velocityOf = [&](const BulletPartner& partner) {
        return (1 / (work.dt - partner.pathFrom)) * (partner.path.c1 - partner.path.c0);
    };
    const auto rimSpeedOf = [&](const BulletPartner& partner, std::uint32_t shape) {
        return std::fabs(partner.path.a1 - partner.path.a0) / (work.dt - partner.pathFrom) *
               turningArm(world.shapes[shape]);
    };
    const double speed = length(velocityOf(second) - velocityOf(first)) + rimSpeedOf(first, pair.shapes.other) +
                         rimSpeedOf(second, pair.shapes.own);
    const double way = kTolerancesOfMoment * toleranceOf(world, pair.shapes);
    const double longest = kLongestMoment * work.dt;
    return way < longest * speed ? way / speed : longest;
}

bool sharesBody(const BulletMeeting& a, const BulletMeeting& b) {
    return a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
}

/// What follows the meeting in `together` within its moment goes with it if it shares a body with one that does.
void addOfSameMoment(WorldState& world) {
    BulletWork& work = world.bulletWork;
    const double time = work.together.front().time;
    const double moment = momentOf(world, work.together.front());
    work.aside.clear();
    while (work.aside.size() < kMostAside && dropStale(work) && work.meetings.front().time - time <= moment) {
        work.aside.push_back(popMeeting(work));
    }
    if (work.aside.empty()) { return; }
    for (std::size_t i = 0; i < work.together.size(); ++i) {
        const BulletMeeting one = work.together[i];
        std::erase_if(work.aside, [&](const BulletMeeting& other) {
            const bool goesAlong =
                other.isPair() && sharesBody(one, other) && other.time - time <= momentOf(world, other);
            if (goesAlong) { work.together.push_back(other); }
            return goesAlong;
        });
    }
    for (const BulletMeeting& meeting : work.aside) { pushMeeting(work, meeting); }
}

}  // namespace

void orderMeetings(BulletWork& work) { std::make_heap(work.meetings.begin(), work.meetings.end(), isLater); }

void pushMeeting(BulletWork& work, const BulletMeeting& meeting) {
    work.meetings.push_back(meeting);
    std::push_heap(work.meetings.begin(), work.meetings.end(), isLater);
}

bool takeMeetings(WorldState& world) {
    BulletWork& work = world.bulletWork;
    work.together.clear();
    if (!dropStale(work)) { return false; }
    work.together.push_back(popMeeting(work));
    if (work.together.front().isPair()) { addOfSameMoment(world); }
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION
