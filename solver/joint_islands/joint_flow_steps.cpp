#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "../../shapes/real.h"
#include "joint_flow.h"

/// How accelerations are gone through: the method of the eighth order, the lengths of its pieces, and what it leaves.

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::size_t kCount = 11;
using Row = std::array<double, kCount>;
using Table = std::array<Row, kCount + 1>;

constexpr double kRoot = 4.58257569495584000658804719372800848898;  // of 21

/// By stage: how much of the accelerations before it speeds take; last how much of all where the piece ends. (Cooper &
/// Verner, "Some explicit Runge–Kutta methods of high order", 1972; in this form in Hairer, Nørsett & Wanner.)
constexpr Table kSpeeds{{
    {},
    {1.0 / 2},
    {1.0 / 4, 1.0 / 4},
    {1.0 / 7, (-7 - 3 * kRoot) / 98, (21 + 5 * kRoot) / 49},
    {(11 + kRoot) / 84, 0, (18 + 4 * kRoot) / 63, (21 - kRoot) / 252},
    {(5 + kRoot) / 48, 0, (9 + kRoot) / 36, (-231 + 14 * kRoot) / 360, (63 - 7 * kRoot) / 80},
    {(10 - kRoot) / 42, 0, (-432 + 92 * kRoot) / 315, (633 - 145 * kRoot) / 90, (-504 + 115 * kRoot) / 70,
     (63 - 13 * kRoot) / 35},
    {1.0 / 14, 0, 0, 0, (14 - 3 * kRoot) / 126, (13 - 3 * kRoot) / 63, 1.0 / 9},
    {1.0 / 32, 0, 0, 0, (91 - 21 * kRoot) / 576, 11.0 / 72, (-385 - 75 * kRoot) / 1152, (63 + 13 * kRoot) / 128},
    {1.0 / 14, 0, 0, 0, 1.0 / 9, (-733 - 147 * kRoot) / 2205, (515 + 111 * kRoot) / 504, (-51 - 11 * kRoot) / 56,
     (132 + 28 * kRoot) / 245},
    {0, 0, 0, 0, (-42 + 7 * kRoot) / 18, (-18 + 28 * kRoot) / 45, (-273 - 53 * kRoot) / 72, (301 + 53 * kRoot) / 72,
     (28 - 28 * kRoot) / 45, (49 - 7 * kRoot) / 18},
    {1.0 / 20, 0, 0, 0, 0, 0, 0, 49.0 / 180, 16.0 / 45, 49.0 / 180, 1.0 / 20},
}};

/// Likewise places, by the square of the time.
constexpr Table placesFor(const Table& speeds) {
    Table places{};
    for (std::size_t i = 0; i <= kCount; ++i) {
        for (std::size_t k = 0; k < kCount; ++k) {
            for (std::size_t j = 0; j < kCount; ++j) { places[i][k] += speeds[i][j] * speeds[j][k]; }
        }
    }
    return places;
}
constexpr Table kPlaces = placesFor(kSpeeds);

/// When stages are, as parts of the piece.
constexpr std::array<double, kCount + 1> timesFor(const Table& speeds) {
    std::array<double, kCount + 1> times{};
    for (std::size_t i = 0; i <= kCount; ++i) {
        for (const double part : speeds[i]) { times[i] += part; }
    }
    return times;
}
constexpr std::array<double, kCount + 1> kTimes = timesFor(kSpeeds);

/// How far accelerations over a piece are from a polynomial of the third degree: what Simpson's rule, on three of the
/// five times whose accelerations count, makes of the speeds otherwise. It goes by the sixth power of the length.
constexpr double kBends[] = {-7.0 / 60, 49.0 / 180, -14.0 / 45, 49.0 / 180, -7.0 / 60};
constexpr std::size_t kStagesOfBends[] = {0, 7, 8, 9, 10};

/// Lengths of pieces, as parts of those in float, where the states between steps are rounded: errors of energy go by
/// the eighth power, or more.
constexpr double kFineness = std::is_same_v<Real, float> ? 1 : 0.5;
/// Radians that bodies turn, or begin to turn, in a piece, and of the oscillation of light links under tension.
constexpr double kMostFlowTurn = 0.5 * kFineness;
constexpr double kMostFlowPhase = 0.75 * kFineness;
/// Beyond 3 the method is unstable; here it takes 1.5 % of the oscillation in each piece.
constexpr double kStablePhase = 2;
/// Radians by which a piece may bend so. What happens within it (a whip cracks) its start does not tell.
constexpr double kMostBend = kFineness == 1 ? 1.0 / (1 << 13) : 1.0 / (1 << 19);
/// Where twice the length does as well.
constexpr double kSmallBend = kMostBend / 64;
/// Of a step: in this part of it a motor has to be able to do what brings it to its speed; the rest of its strength is
/// what it may hold with.
constexpr double kPartOfJerk = 1.0 / 16;
/// Each takes away all but what bodies turn by meanwhile.
constexpr int kMostClosings = 4;

using Coordinates = JointFlow::Coordinates;

/// What speeds and places take of the accelerations before the stage. Unrolled: most of the tables is zeros.
template <std::size_t kStage, std::size_t kOf = 0>
void addParts(const std::array<Coordinates, kCount>& accelerations, Coordinates& gained, Coordinates& led) {
    if constexpr (kOf < kStage) {
        if constexpr (kSpeeds[kStage][kOf] != 0) { gained += kSpeeds[kStage][kOf] * accelerations[kOf]; }
        if constexpr (kPlaces[kStage][kOf] != 0) { led += kPlaces[kStage][kOf] * accelerations[kOf]; }
        addParts<kStage, kOf + 1>(accelerations, gained, led);
    }
}

Coordinates bendOf(const std::array<Coordinates, kCount>& accelerations) {
    Coordinates bend;
    for (std::size_t i = 0; i < 5; ++i) { bend += kBends[i] * accelerations[kStagesOfBends[i]]; }
    return bend;
}

}  // namespace

/// Where the next piece starts, after one that was too long, too.
void JointFlow::begin() {
    for (Node& node : nodes_) {
        if (node.isStill) { continue; }
        node.place = node.startPlace;
        node.velocity = node.startVelocity;
        turn(node);
    }
}

/// Pieces per second that the state asks for. @pre the accelerations of its first stage
double JointFlow::rate(double mostPhase) {
    tensions_.assign(nodes_.size(), 0);
    double turn = 0;
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        const double rate = std::max(node.damping, node.angularDamping);
        turn = std::max(turn, rate * rate);
        const double spin = node.velocity.turn;
        if (node.isLever) { turn = std::max(turn, std::max(spin * spin, std::fabs(node.reached.turn))); }
        if (node.parent == kNone) { continue; }
        const double force = norm(pushOn(node).linear());
        tensions_[n] += force * node.ease;
        tensions_[node.parent] += force * node.easeOfParent;
    }
    const double spring = fastestSpring();
    turn = std::max(turn, spring * spring);
    double tension = 0;
    for (const double each : tensions_) { tension = std::max(tension, each); }
    return std::sqrt(std::max(turn / (kMostFlowTurn * kMostFlowTurn), tension / (mostPhase * mostPhase)));
}

template <std::size_t kStage>
void JointFlow::moveTo(double time) {
    for (Node& node : nodes_) {
        if (node.isStill) { continue; }
        Coordinates gained;
        Coordinates led;
        addParts<kStage>(node.accelerations, gained, led);
        node.velocity = node.startVelocity + time * gained;
        node.place = node.startPlace + time * (kTimes[kStage] * node.startVelocity + time * led);
        turn(node);
    }
}

void JointFlow::addImpulses(double time) {
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        if (node.parent == kNone) { continue; }
        const Coordinates whole = pushOn(node);
        const DVec2 push = whole.linear();
        node.given.impulse += time * push;
        node.given.twist += time * (whole.turn - cross(node.armOfJoint, push));
        const bool isSide = node.kind == IslandHold::Kind::side;
        node.given.along += time * (isSide ? cross(node.direction, push) : dot(node.direction, push));
    }
    addHeld(time);
}

/// @pre the accelerations of its first stage
void JointFlow::step(double time) {
    const Row& weights = kSpeeds[kStages];
    for (Node& node : nodes_) { node.given = node.total; }
    for (Drive& drive : drives_) {
        drive.ofMotor = drive.is.motorTotal;
        drive.ofSpring = drive.is.springTotal;
    }
    addImpulses(weights[0] * time);
    addPushes(weights[0] * time);
    const auto goThrough = [&]<std::size_t... kBefore>(std::index_sequence<kBefore...>) {
        const auto pass = [&]<std::size_t kStage>(std::integral_constant<std::size_t, kStage>) {
            moveTo<kStage>(time);
            accelerate(kStage);
            if (weights[kStage] != 0) {
                addImpulses(weights[kStage] * time);
                addPushes(weights[kStage] * time);
            }
        };
        (pass(std::integral_constant<std::size_t, kBefore + 1>()), ...);
    };
    goThrough(std::make_index_sequence<kStages - 1>());
    ++pieces_;
}

/// Radians by which the piece was not smooth.
double JointFlow::bend(double time) const {
    double worst = 0;
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        const Coordinates own = bendOf(node.accelerations);
        worst = worse(worst, std::fabs(own.turn));
        // What swings on a rod, or slides, need not turn.
        if (node.parent == kNone || node.kind == IslandHold::Kind::point) { continue; }
        const Coordinates apart = own - bendOf(nodes_[node.parent].accelerations);
        if (norm(apart.linear()) > 0) { worst = worse(worst, norm(apart.linear()) / node.reach); }
    }
    return worst * time * time;
}

void JointFlow::accept(double time) {
    moveTo<kStages>(time);
    for (Node& node : nodes_) {
        node.startPlace = node.place;
        node.startVelocity = node.velocity;
        node.total = node.given;
    }
    for (Drive& drive : drives_) {
        drive.is.motorTotal = drive.ofMotor;
        drive.is.springTotal = drive.ofSpring;
    }
}

bool JointFlow::advance(double duration, double most, Tremor tremor) {
    const double mostPhase = tremor == Tremor::followed ? kMostFlowPhase : kStablePhase;
    double left = duration;
    double longest = duration;
    begin();
    agree();
    if (!areWithinStrength(kPartOfJerk * duration)) { return false; }  // that brings motors to their speeds at once
    for (Drive& drive : drives_) {
        drive.is.motorTotal = drive.ofMotor;
        drive.is.most -= std::fabs(drive.ofMotor) / duration;
    }
    while (left > 0) {
        accelerate(0);
        longest = std::min(longest, 1 / rate(mostPhase));
        const double wanted = std::ceil(left / longest);
        if (!(pieces_ + wanted <= most)) { return false; }
        const double time = wanted > 1 ? left / wanted : left;
        step(time);
        const double bent = bend(time);
        if (bent <= kMostBend) {
            if (!areWithinStrength(time)) { return false; }
            accept(time);
            if (!areDrivesSame()) { return false; }
            left = wanted > 1 ? left - time : 0;
            if (bent <= kSmallBend) { longest *= 2; }
        } else {
            longest = 0.5 * time;
            begin();
        }
    }
    return settle();
}

/// Brings joints together that begin, or are left, apart by rounding.
bool JointFlow::settle() {
    double worst = 0;
    for (int round = 0;; ++round) {
        placeJoints();
        worst = closeGaps();
        if (worst <= kNoGapRatio || round >= kMostClosings) { break; }
        for (Node& node : nodes_) { node.force = {}; }
        solve();
        for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
            Node& node = nodes_[n];
            node.place += node.reached;
            turn(node);
        }
    }
    return worst <= kLeftGapRatio;
}

/// Sets biases to what would close the gaps.
double JointFlow::closeGaps() {
    double worst = 0;
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        if (node.parent == kNone) { continue; }
        const Node& parent = nodes_[node.parent];
        const DVec2 between = armsOf(node, parent).between;
        DVec2 gap = between;
        if (node.kind == IslandHold::Kind::rod) {
            gap = (dot(between, node.direction) - node.rest) * node.direction;
        } else if (node.kind == IslandHold::Kind::side) {
            gap = between - dot(between, node.direction) * node.direction;
        }
        const double bent = node.angleHold == kNone ? 0 : node.restAngle + (node.place.turn - parent.place.turn);
        const DVec2 arm = node.armOfJoint;
        node.bias = {-gap.x - bent * arm.y, -gap.y + bent * arm.x, -bent};
        const double scale = node.size + norm(node.place.linear()) + norm(parent.place.linear());
        if (norm(gap) > 0) { worst = worse(worst, norm(gap) / scale); }
        worst = worse(worst, std::fabs(bent) / (1 + std::fabs(node.place.turn) + std::fabs(parent.place.turn)));
    }
    return worst;
}

/// Takes away the speeds that joints do not allow: what rounding left, or a jerk of what the user set.
void JointFlow::agree() {
    placeJoints();
    for (Node& node : nodes_) { node.force = {}; }
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        if (node.parent == kNone) { continue; }
        const Node& parent = nodes_[node.parent];
        const DVec2 span = spanOf(node, parent);
        const Coordinates& led = parent.velocity;
        node.bias = {led.x - led.turn * span.y - node.velocity.x, led.y + led.turn * span.x - node.velocity.y,
                     led.turn - node.velocity.turn};
    }
    wantSpeeds();
    solve();
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        node.velocity += node.reached;
        node.startVelocity = node.velocity;
        const Coordinates& v = node.velocity;
        begun_ += 0.5 * (node.mass * (v.x * v.x + v.y * v.y) + node.inertia * (v.turn * v.turn));
    }
    addImpulses(1);
    for (Node& node : nodes_) { node.total = node.given; }
}

void JointFlow::finish(std::span<IslandBody> bodies, std::span<IslandHold> holds, std::span<IslandDrive> drives) const {
    for (const Node& node : nodes_) {
        IslandBody& body = bodies[node.body];
        body.place = {node.place.linear(), node.place.turn, node.c, node.s};
        body.velocity = node.velocity.linear();
        body.spin = node.velocity.turn;
        if (node.parent == kNone || node.isFixed) { continue; }
        IslandHold& hold = holds[node.hold];
        const double sign = node.isB ? 1 : -1;
        hold.reaction = sign * node.total.impulse;
        hold.rows[0].total = node.kind == IslandHold::Kind::point ? hold.reaction.x : node.total.along;
        if (node.kind == IslandHold::Kind::point) { hold.rows[1].total = hold.reaction.y; }
        if (node.kind == IslandHold::Kind::side) { hold.rows[0].total = sign * node.total.along; }
        if (node.angleHold != kNone) {
            IslandHold& angle = holds[node.angleHold];
            angle.twist = sign * node.total.twist;
            angle.rows[0].total = angle.twist;
        }
    }
    for (const Drive& drive : drives_) {
        IslandDrive& result = drives[drive.number];
        result.motorTotal = drive.is.motorTotal;
        result.springTotal = drive.is.springTotal;
        if (drive.is.way == IslandDrive::Way::turn) {
            holds[nodes_[drive.node].hold].twist += result.motorTotal + result.springTotal;
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
