#include "joint_flow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../../shapes/compiler.h"
#include "../../shapes/trig.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

using Coordinates = JointFlow::Coordinates;
using Inertia = JointFlow::Inertia;

/// Of speeds in half a sub-step: what is damped more has stopped at the end of the step.
constexpr double kLeastDecay = 0.75;

double dotOf(const Coordinates& a, const Coordinates& b) { return a.x * b.x + a.y * b.y + a.turn * b.turn; }

/// Acceleration of a centre towards the end of an arm that turns so.
DVec2 drawIn(double spin, DVec2 arm) { return spin * spin * arm; }
Coordinates times(const Inertia& m, const Coordinates& v) {
    return {m.xx * v.x + m.yx * v.y + m.tx * v.turn, m.yx * v.x + m.yy * v.y + m.ty * v.turn,
            m.tx * v.x + m.ty * v.y + m.tt * v.turn};
}
double inertiaAlong(const Inertia& m, const Coordinates& v) {
    const double squares = (m.xx * (v.x * v.x) + m.yy * (v.y * v.y)) + m.tt * (v.turn * v.turn);
    return squares + 2 * ((m.tx * (v.x * v.turn) + m.ty * (v.y * v.turn)) + m.yx * (v.x * v.y));
}
/// m −= a·bᵀ @pre that is symmetric
void subtractOuter(Inertia& m, const Coordinates& a, const Coordinates& b) {
    m.xx -= a.x * b.x;
    m.yx -= a.y * b.x;
    m.yy -= a.y * b.y;
    m.tx -= a.turn * b.x;
    m.ty -= a.turn * b.y;
    m.tt -= a.turn * b.turn;
}
/// What is led by something from which it is a span away moves so.
Coordinates ledBy(const Coordinates& v, DVec2 span) { return {v.x - v.turn * span.y, v.y + v.turn * span.x, v.turn}; }
/// Likewise an inertia, added to that of what leads.
void addMoved(Inertia& to, const Inertia& m, DVec2 span) {
    to.xx += m.xx;
    to.yx += m.yx;
    to.yy += m.yy;
    to.tx += m.tx + (m.yx * span.x - m.xx * span.y);
    to.ty += m.ty + (m.yy * span.x - m.yx * span.y);
    const double turning = m.yy * (span.x * span.x) + m.xx * (span.y * span.y);
    const double both = (m.ty * span.x - m.tx * span.y) - m.yx * (span.x * span.y);
    to.tt += (m.tt + turning) + 2 * both;
}

/// Likewise of what has a mass at the end of an arm, and no inertia to turns.
SWEPT_FORCE_INLINE void addAtArm(Inertia& to, double xx, double yx, double yy, DVec2 arm) {
    to.xx += xx;
    to.yx += yx;
    to.yy += yy;
    to.tx += yx * arm.x - xx * arm.y;
    to.ty += yy * arm.x - yx * arm.y;
    to.tt += (yy * (arm.x * arm.x) + xx * (arm.y * arm.y)) - 2 * (yx * (arm.x * arm.y));
}

/// Of a pin: that of the point, which a turn does not change.
DVec2 biasOfPin(const auto& node) { return node.bias.linear() + node.bias.turn * leftOf(node.armOfJoint); }

/// What takes away speeds, and adds to them, evenly.
struct Damping {
    double rate;    ///< 1/s
    double drives;  ///< acceleration for what the time adds, 1/s
};
/// From what is left of a speed after the time.
Damping dampingOf(double decay, double time) {
    if (decay == 1) { return {0, 1 / time}; }
    // −ln d = 2·artanh((1 − d)/(1 + d)); what is left out is below 2⁻⁴⁵ of it.
    const double part = (1 - decay) / (1 + decay);
    const double square = part * part;
    const double series =
        1 + square * (1.0 / 3 +
                      square * (1.0 / 5 + square * (1.0 / 7 + square * (1.0 / 9 + square * (1.0 / 11 + square / 13)))));
    const double rate = 2 * part * series / time;
    return {rate, rate / (1 - decay)};
}

}  // namespace

bool JointFlow::mayTake(const IslandBody& body) {
    return body.inverseMass > 0 && body.inverseInertia > 0 && std::min(body.decay, body.angularDecay) >= kLeastDecay;
}

JointFlow::Node& JointFlow::addNode(const Island& island, std::uint32_t i) {
    nodeOf_[i] = static_cast<std::uint32_t>(nodes_.size());
    Node& node = nodes_.emplace_back();
    const IslandBody& body = island.bodies[i];
    node.body = i;
    node.startVelocity = {body.velocity.x, body.velocity.y, body.spin};
    return node;
}

/// What moves a body of a tree but its joints.
void JointFlow::setDrive(Node& node, const IslandBody& body, double h) {
    node.mass = 1 / body.inverseMass;
    node.inertia = 1 / body.inverseInertia;
    const Damping linearly = dampingOf(body.decay, 0.5 * h);
    const Damping angularly = dampingOf(body.angularDecay, 0.5 * h);
    node.drive = {linearly.drives * body.gain.x, linearly.drives * body.gain.y, angularly.drives * body.angularGain};
    node.damping = linearly.rate;
    node.angularDamping = angularly.rate;
}

/// @pre what it hangs on has its node
void JointFlow::hang(Node& node, const Island& island) {
    const IslandHold& hold = island.holds[node.hold];
    node.kind = hold.kind;
    node.isB = hold.b == node.body;
    const std::uint32_t other = node.isB ? hold.a : hold.b;
    node.parent = nodeOf_[other];
    node.anchor = node.isB ? hold.anchorB : hold.anchorA;
    node.anchorOfParent = node.isB ? hold.anchorA : hold.anchorB;
    node.offset = node.isB ? hold.offset : -hold.offset;
    node.axis = hold.axis;
    node.rest = hold.rest;
    node.size = hold.size;
    // A slider may stand where it has no size.
    node.reach = std::max(node.size, std::sqrt(node.inertia / node.mass));
    const bool mayTurn = node.angleHold == kNone;
    if (!mayTurn) {
        node.restAngle = node.isB ? island.holds[node.angleHold].rest : -island.holds[node.angleHold].rest;
    }
    const IslandBody& body = island.bodies[node.body];
    const IslandBody& bodyOfParent = island.bodies[other];
    node.ease = body.inverseMass * easeOf(body, node.anchor);
    node.easeOfParent = bodyOfParent.inverseMass * easeOf(bodyOfParent, node.anchorOfParent);
    Node& parent = nodes_[node.parent];
    const bool isSide = node.kind == IslandHold::Kind::side;
    node.isLever = norm(node.anchor) > 0 || (isSide && !node.isB);
    parent.isLever = parent.isLever || norm(node.anchorOfParent) > 0 || (isSide && node.isB);
    addDrives(node, island);
    const bool mayMoveOff = node.kind != IslandHold::Kind::point && !node.holdsSlide;
    node.freedoms = (mayMoveOff ? 1 : 0) + (mayTurn && !node.holdsTurn ? 1 : 0);
    node.isPin = node.kind == IslandHold::Kind::point && node.freedoms == 1;
}

void JointFlow::start(const Island& island, double h) {
    evaluations_ = pieces_ = 0;
    begun_ = 0;
    nodes_.clear();
    drives_.clear();
    nodeOf_.assign(island.bodies.size(), kNone);
    for (std::uint32_t i = 0; i < island.bodies.size(); ++i) {
        if (island.bodies[i].inverseMass > 0) { continue; }
        Node& node = addNode(island, i);
        node.isFixed = true;
        node.isStill = node.startVelocity == Coordinates{};
    }
    fixed_ = nodes_.size();
    for (const IslandBranch& branch : island.branches) {
        Node& node = addNode(island, branch.body);
        setDrive(node, island.bodies[branch.body], h);
        node.hold = branch.holds[0];
        node.angleHold = branch.holds[1];
        if (node.hold == kNone) {  // the first of what hangs on nothing
            node.freedoms = 3;
            node.free[0].along = {1, 0, 0};
            node.free[1].along = {0, 1, 0};
            node.free[2].along = {0, 0, 1};
        } else {
            hang(node, island);
        }
    }
}

void JointFlow::turn(Node& node) {
    const SinCos turn = sinCos(node.place.turn);
    node.c = turn.cos;
    node.s = turn.sin;
}

DVec2 JointFlow::spanOf(const Node& node, const Node& parent) {
    return node.offset + node.place.linear() - parent.place.linear();
}

JointFlow::Arms JointFlow::armsOf(const Node& node, const Node& parent) {
    const DVec2 own = turned(node.c, node.s, node.anchor);
    const DVec2 ofParent = turned(parent.c, parent.s, node.anchorOfParent);
    return {own, ofParent, spanOf(node, parent) + own - ofParent};
}

/// Of the own anchor, seen from the parent's.
DVec2 JointFlow::speedAt(const Arms& arms, const Node& node, const Node& parent) {
    return node.velocity.linear() - parent.velocity.linear() + node.velocity.turn * leftOf(arms.own) -
           parent.velocity.turn * leftOf(arms.ofParent);
}

void JointFlow::setPoint(Node& node, const Node& parent) {
    const DVec2 arm = turned(node.c, node.s, node.anchor);
    const DVec2 armOfParent = turned(parent.c, parent.s, node.anchorOfParent);
    const DVec2 bias = drawIn(node.velocity.turn, arm) - drawIn(parent.velocity.turn, armOfParent);
    node.armOfJoint = arm;
    node.armOfParent = armOfParent;
    node.bias = {bias.x, bias.y, 0};
}

/// A body that is held at a distance may move across, and turn.
void JointFlow::setRod(Node& node, const Node& parent) {
    const Arms arms = armsOf(node, parent);
    const double apart = length(arms.between);
    if (apart > 0) { node.direction = (1 / apart) * arms.between; }
    const DVec2 across = leftOf(node.direction);
    const double swing = apart > 0 ? dot(across, speedAt(arms, node, parent)) / apart : 0;
    const DVec2 bias = drawIn(node.velocity.turn, arms.own) - drawIn(parent.velocity.turn, arms.ofParent) -
                       drawIn(swing, arms.between);
    node.armOfJoint = arms.own;
    node.bias = {bias.x, bias.y, 0};
    node.free[0].along = {across.x, across.y, 0};
    node.free[1].along = Coordinates::turnAbout(arms.own);
}

/// One that slides along an axis fixed in A, and may turn about B's anchor.
void JointFlow::setSide(Node& node, const Node& parent) {
    const Node& a = node.isB ? parent : node;
    const Arms arms = armsOf(node, parent);
    node.direction = turned(a.c, a.s, node.axis);
    const double sliding = dot(node.direction, speedAt(arms, node, parent));
    // The joint's force acts where B's anchor is.
    node.armOfJoint = node.isB ? arms.own : arms.own - arms.between;
    const DVec2 throughParent = node.isB ? arms.ofParent + arms.between : arms.ofParent;
    const DVec2 bias = drawIn(node.velocity.turn, node.armOfJoint) - drawIn(parent.velocity.turn, throughParent) +
                       2 * a.velocity.turn * sliding * leftOf(node.direction);
    node.bias = {bias.x, bias.y, 0};
    std::size_t way = 0;
    if (!node.holdsSlide) { node.free[way++].along = {node.direction.x, node.direction.y, 0}; }
    node.free[way].along = Coordinates::turnAbout(node.armOfJoint);
}

void JointFlow::placeJoints() {
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        if (node.parent == kNone) { continue; }
        const Node& parent = nodes_[node.parent];
        switch (node.kind) {
            case IslandHold::Kind::point:
                setPoint(node, parent);
                break;
            case IslandHold::Kind::rod:
                setRod(node, parent);
                break;
            case IslandHold::Kind::side:
                setSide(node, parent);
                break;
            case IslandHold::Kind::angle:  // follows one of the others
                break;
        }
    }
}

/// Finds how the body resists, with all that hangs on it and as it is free, and adds that to its parent. (The shortest
/// way from one body's inertia to the next one's counts: they wait for each other.)
void JointFlow::eliminate(Node& node) {
    Inertia inertia = node.carried;
    Coordinates force = node.force - times(inertia, node.bias);
    for (std::size_t i = 0; i < node.freedoms; ++i) {
        Freedom& freedom = node.free[i];
        const Coordinates pushed = times(inertia, freedom.along);
        const double inverse = 1 / inertiaAlong(inertia, freedom.along);
        freedom.ease = inverse * pushed;
        freedom.pushed = pushed;
        const double along = dotOf(freedom.along, force);
        freedom.gain = inverse * along;
        force -= along * freedom.ease;
        if (i + 1 < node.freedoms) { subtractOuter(inertia, pushed, freedom.ease); }
    }
    if (node.parent == kNone || nodes_[node.parent].isFixed) { return; }
    Node& parent = nodes_[node.parent];
    const DVec2 span = spanOf(node, parent);
    addMoved(parent.carried, node.carried, span);
    for (std::size_t i = 0; i < node.freedoms; ++i) {
        subtractOuter(parent.carried, node.free[i].pushed.moved(span), node.free[i].ease.moved(span));
    }
    parent.force += force.moved(span);
}

/// The same of what turns about a point, seen from there: of its inertia nothing is left to turns.
void JointFlow::eliminatePin(Node& node) {
    const Inertia& m = node.carried;
    const DVec2 arm = node.armOfJoint;
    const double tx = m.tx - (m.yx * arm.x - m.xx * arm.y);
    const double ty = m.ty - (m.yy * arm.x - m.yx * arm.y);
    const double turning = m.yy * (arm.x * arm.x) + m.xx * (arm.y * arm.y);
    const double both = (m.tx * arm.y - m.ty * arm.x) - m.yx * (arm.x * arm.y);
    const double inverse = 1 / ((m.tt + turning) + 2 * both);
    Freedom& turn = node.free[0];
    turn.ease = {inverse * tx, inverse * ty, 0};
    turn.gain = inverse * (node.force.turn - cross(arm, node.force.linear()));
    Node& parent = nodes_[node.parent];
    if (parent.isFixed) { return; }
    const double xx = m.xx - tx * turn.ease.x;
    const double yx = m.yx - ty * turn.ease.x;
    const double yy = m.yy - ty * turn.ease.y;
    addAtArm(parent.carried, xx, yx, yy, node.armOfParent);
    const DVec2 bias = biasOfPin(node);
    const DVec2 force{(node.force.x - tx * turn.gain) - (xx * bias.x + yx * bias.y),
                      (node.force.y - ty * turn.gain) - (yx * bias.x + yy * bias.y)};
    parent.force += Coordinates{force.x, force.y, cross(node.armOfParent, force)};
}

void JointFlow::reachByPin(Node& node) const {
    const Node& parent = nodes_[node.parent];
    const DVec2 led = parent.reached.linear() + parent.reached.turn * leftOf(node.armOfParent) + biasOfPin(node);
    const Freedom& turn = node.free[0];
    const double reached = turn.gain - (turn.ease.x * led.x + turn.ease.y * led.y);
    const DVec2 center = led - reached * leftOf(node.armOfJoint);
    node.reached = {center.x, center.y, reached};
}

/// What a body reaches whose parent's is known.
void JointFlow::reach(Node& node) const {
    Coordinates reached{};
    if (node.parent != kNone) {
        const Node& parent = nodes_[node.parent];
        reached = ledBy(parent.reached, spanOf(node, parent));
    }
    Coordinates free{};
    for (std::size_t i = node.freedoms; i-- > 0;) {
        const Freedom& freedom = node.free[i];
        const double along = freedom.gain - dotOf(freedom.ease, reached) - dotOf(freedom.ease, free);
        free += along * freedom.along;
    }
    node.reached = (reached + node.bias) + free;
}

/// Finds what is reached by the forces and biases. @pre joints are placed, forces set
void JointFlow::solve() {
    ++evaluations_;
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        nodes_[n].carried = {.xx = nodes_[n].mass, .yy = nodes_[n].mass, .tt = nodes_[n].inertia};
    }
    for (std::size_t n = nodes_.size(); n-- > fixed_;) {
        Node& node = nodes_[n];
        node.isPin ? eliminatePin(node) : eliminate(node);
    }
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        node.isPin ? reachByPin(node) : reach(node);
    }
}

/// Of the joint on its body, as the last solve found it.
Coordinates JointFlow::pushOn(const Node& node) { return times(node.carried, node.reached) - node.force; }

void JointFlow::loadDrives() {
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) {
        Node& node = nodes_[n];
        const Coordinates& v = node.velocity;
        node.force = {node.mass * (node.drive.x - node.damping * v.x), node.mass * (node.drive.y - node.damping * v.y),
                      node.inertia * (node.drive.turn - node.angularDamping * v.turn)};
    }
}

void JointFlow::accelerate(std::size_t stage) {
    placeJoints();
    loadDrives();
    if (!drives_.empty()) { pullSprings(); }
    solve();
    for (std::size_t n = fixed_; n < nodes_.size(); ++n) { nodes_[n].accelerations[stage] = nodes_[n].reached; }
}

}  // namespace swept::inline SWEPT_PRECISION
