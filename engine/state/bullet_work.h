#pragma once

#include <compare>
#include <cstdint>
#include <tuple>
#include <vector>

#include "../../broadphase/wide_tree.h"
#include "../../shapes/raw_vector.h"
#include "flight_work.h"
#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

/// A bullet, or a dynamic body that one may meet in this step.
struct BulletPartner {
    Flight flight;        ///< while it flies
    Sweep path;           ///< from `pathFrom` to the end of the step
    double pathFrom = 0;  ///< seconds
    int impacts = 0;
    std::uint32_t clash = kNoIndex;  ///< that dissolved, of which it was: it may meet all other members
    bool isBullet = false;
    bool flies = false;  ///< else it is on its way by the solver, or rests
    /// To other bodies: it stays on its way, whatever hits it; only its velocity changes. (But see `mayLeave`.)
    bool tied = false;
    bool moved = false;    ///< here: what the solver made of its pose is out of date
    bool stopped = false;  ///< here, or it rides on another one
    /// Of what is tied: by how much its path is faster than the velocity that it ends with, m/s and rad/s. What a stop
    /// holds at the end of its way struck at the speed of that way.
    Vec2 lead{};
    Real angularLead = 0;
    bool left = false;  ///< it was tied, and flies instead of going through what is on the way that the solver gave it

    std::uint32_t changes = 0;              ///< of its path so far
    std::uint32_t firstCarrier = kNoIndex;  ///< place in `BulletWork::carriers`, of those to bodies of higher slots
};

/// What two bodies do that met and did not bounce: they may sag along the normal.
struct BulletCarrier {
    std::uint32_t other = 0;  ///< slot of the second body
    Vec2 normal{};            ///< from first to second; zero: it bounced since
    std::uint32_t next = 0;   ///< of the same first body
};

/// What happens next, unless the path of one of both changes before.
struct BulletMeeting {
    double time = 0;           ///< seconds
    std::uint32_t first = 0;   ///< slots of bodies; the lower one of a pair
    std::uint32_t second = 0;  ///< `kNoIndex`: the first one meets something static or kinematic
    std::uint32_t firstChanges = 0;
    std::uint32_t secondChanges = 0;
    FlightObstacle shapes;  ///< that meet: `own` of the second, `other` of the first

    bool isPair() const { return second != kNoIndex; }
    /// In order of time; what happens at one moment in one that follows from the slots alone.
    bool isAfter(const BulletMeeting& other) const {
        return std::tuple(time, isPair(), first, second) >
               std::tuple(other.time, other.isPair(), other.first, other.second);
    }
};

/// A bullet that joints hold, and a dynamic body that it may meet in this step, or a whirl (in place of the bullet) and
/// a bullet: slots.
struct AheadPair {
    std::uint32_t bullet = 0;
    std::uint32_t other = 0;
};

/// See whirls.h.
struct Whirl {
    std::uint32_t body = 0;  ///< slot
    Vec2 localPivot{};       ///< its hinge, body frame
    double spin = 0;         ///< rad/s within the step, no less
    double turn = 0;         ///< radians within the step, no less
    double way = 1;          ///< 1: counter-clockwise, -1: clockwise
    Aabb box{};              ///< of all that it may sweep
    int met = 0;             ///< bullets in its way
};

struct WhirlMeeting {
    std::uint32_t whirl = 0;   ///< place in `BulletWork::whirls`
    std::uint32_t bullet = 0;  ///< slot

    auto operator<=>(const WhirlMeeting&) const = default;
};

/// What one worker found. Nothing of it shares a cache line with another worker's.
struct alignas(kCacheLine) BulletFinds {
    std::vector<BulletMeeting> meetings;
    std::vector<std::uint32_t> bodies;  ///< slots
};

struct BulletWork {
    RawVector<BulletPartner> partners;    ///< at first in an order in which neighbours follow each other
    std::vector<std::uint32_t> slots;     ///< by partner
    std::vector<std::uint32_t> indices;   ///< by body: of its partner; `kNoIndex` for all others
    std::vector<BulletMeeting> meetings;  ///< a heap: the next one is the first
    std::vector<BulletCarrier> carriers;
    std::vector<Aabb> boxes;            ///< by partner, of its path
    std::vector<std::uint32_t> places;  ///< by partner, in the tree
    WideTree tree;                      ///< of the boxes
    std::vector<BulletFinds> finds;     ///< by worker
    /// By body: some contact pressed it in the solve of this step. Listed when somebody asks.
    std::vector<std::uint8_t> pressed;
    bool isPressedListed = false;
    Real drift = 0;              ///< no body that is none of the early partners leaves its box farther, metres
    Real farthest = 0;           ///< how far any body gets at the speed that it has as the step begins, metres
    bool areSomeAtRest = false;  ///< bullets that look for nobody: they sleep, or hardly move
    double dt = 0;

    std::vector<AheadPair> ahead;          ///< what jointed bullets may meet (bullets_ahead.h), and whirls
    std::vector<Whirl> whirls;             ///< of this step, by body
    std::vector<WhirlMeeting> nearWhirls;  ///< scratch
    std::vector<Aabb> whirlBoxes;          ///< scratch

    // Of this moment.
    std::vector<BulletMeeting> together;  ///< those that share bodies; or one, of something static or kinematic
    std::vector<std::uint32_t> members;   ///< indices of all that they name
    std::vector<Real> separations;        ///< of those that are in reach, metres

    // Scratch.
    std::vector<BulletMeeting> aside;
    std::vector<std::uint32_t> searchers;  ///< indices
    std::vector<std::uint32_t> early;      ///< slots, as the next one
    std::vector<std::uint32_t> found;
    std::vector<std::uint8_t> reached;  ///< by place in `early`
};

}  // namespace swept::inline SWEPT_PRECISION
