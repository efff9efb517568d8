#include <algorithm>
#include <cmath>
#include <cstdint>

#include "joint_flow.h"

/// What springs and motors do along the directions that joints leave free.

namespace swept::inline SWEPT_PRECISION {
namespace {

using Coordinates = JointFlow::Coordinates;

}  // namespace

/// @pre its joint is set
void JointFlow::addDrives(Node& node, const Island& island) {
    const IslandHold& hold = island.holds[node.hold];
    for (std::uint32_t i = hold.firstDrive; i < hold.firstDrive + hold.drives; ++i) {
        const IslandDrive& drive = island.drives[i];
        drives_.push_back({.is = drive,
                           .number = i,
                           .node = static_cast<std::uint32_t>(&node - nodes_.data()),
                           .sign = node.isB ? 1.0 : -1.0});
        if (drive.motor != IslandDrive::Motor::holds) { continue; }
        (drive.way == IslandDrive::Way::turn ? node.holdsTurn : node.holdsSlide) = true;
    }
}

/// @pre joints are placed
JointFlow::DriveMotion JointFlow::motionOf(const Drive& drive) const {
    const Node& node = nodes_[drive.node];
    const Node& parent = nodes_[node.parent];
    if (drive.is.way == IslandDrive::Way::turn) {
        return {drive.is.place + drive.sign * (node.place.turn - parent.place.turn),
                drive.sign * (node.velocity.turn - parent.velocity.turn)};
    }
    const Arms arms = armsOf(node, parent);
    return {drive.sign * dot(node.direction, arms.between),
            drive.sign * dot(node.direction, speedAt(arms, node, parent))};
}

/// How a push along it acts on the node. @pre joints are placed
JointFlow::Coordinates JointFlow::directionOf(const Drive& drive, const Node& node) {
    if (drive.is.way == IslandDrive::Way::turn) { return {0, 0, drive.sign}; }
    const DVec2 along = drive.sign * node.direction;
    return {along.x, along.y, cross(node.armOfJoint, along)};
}

/// Adds them, and what motors push with, to the forces. @pre joints are placed
void JointFlow::pullSprings() {
    for (Drive& drive : drives_) {
        Node& node = nodes_[drive.node];
        Node& parent = nodes_[node.parent];
        const DVec2 span = spanOf(node, parent);
        double force = 0;
        if (drive.is.hasSpring) {
            const DriveMotion now = motionOf(drive);
            const DVec2 ofParent = node.armOfJoint + span;
            const double mass = node.isB ? drive.is.massAt(node.direction, ofParent, node.armOfJoint)
                                         : drive.is.massAt(node.direction, node.armOfJoint, ofParent);
            drive.pull = -mass * (drive.is.stiffness * now.place + drive.is.damping * now.speed) -
                         drive.is.fixedStiffness * now.place;
            force += drive.pull;
        }
        if (drive.is.motor == IslandDrive::Motor::pushes) { force += drive.is.push; }
        const Coordinates push = force * directionOf(drive, node);
        node.force += push;
        if (!parent.isFixed) { parent.force -= push.moved(span); }
    }
}

/// What they gave, by so much time.
void JointFlow::addPushes(double time) {
    for (Drive& drive : drives_) {
        Node& node = nodes_[drive.node];
        const double ofSpring = drive.is.hasSpring ? time * drive.pull : 0;
        const double ofMotor = drive.is.motor == IslandDrive::Motor::pushes ? time * drive.is.push : 0;
        drive.ofSpring += ofSpring;
        drive.ofMotor += ofMotor;
        node.given.impulse += (ofSpring + ofMotor) * directionOf(drive, node).linear();
    }
}

/// Of motors that hold: what their joints did along them.
void JointFlow::addHeld(double time) {
    for (Drive& drive : drives_) {
        if (drive.is.motor != IslandDrive::Motor::holds) { continue; }
        const Node& node = nodes_[drive.node];
        const Coordinates whole = pushOn(node);
        const double along = drive.is.way == IslandDrive::Way::turn
                                 ? whole.turn - cross(node.armOfJoint, whole.linear())
                                 : dot(node.direction, whole.linear());
        drive.ofMotor += time * drive.sign * along;
    }
}

/// The rate at which one swings, or comes to rest, 1/s. (Two such springs in a row swing faster, by a root of two.)
double JointFlow::fastestSpring() const {
    double fastest = 0;
    for (const Drive& drive : drives_) { fastest = std::max(fastest, drive.is.springRate); }
    return fastest;
}

/// Adds to the biases of speeds what motors hold. @pre joints are placed
void JointFlow::wantSpeeds() {
    for (const Drive& drive : drives_) {
        if (drive.is.motor != IslandDrive::Motor::holds) { continue; }
        Node& node = nodes_[drive.node];
        const Coordinates along = drive.is.way == IslandDrive::Way::turn
                                      ? Coordinates::turnAbout(node.armOfJoint)
                                      : Coordinates{node.direction.x, node.direction.y, 0};
        node.bias += (drive.sign * drive.is.speed) * along;
    }
}

/// Whether no limit is reached, and motors that push have not reached their speed.
bool JointFlow::areDrivesSame() {
    if (drives_.empty()) { return true; }
    placeJoints();
    return std::all_of(drives_.begin(), drives_.end(), [this](const Drive& drive) {
        const DriveMotion now = motionOf(drive);
        const bool isWithin = !drive.is.hasLimits || (now.place >= drive.is.lower && now.place <= drive.is.upper);
        const bool pushes = drive.is.motor == IslandDrive::Motor::pushes;
        return isWithin && !(pushes && (drive.is.speed - now.speed) * drive.is.push <= 0);
    });
}

/// Whether motors could hold what they held since the last piece.
bool JointFlow::areWithinStrength(double time) const {
    return std::all_of(drives_.begin(), drives_.end(), [time](const Drive& drive) {
        const double given = drive.ofMotor - drive.is.motorTotal;
        return drive.is.motor != IslandDrive::Motor::holds || std::fabs(given) <= drive.is.most * time;
    });
}

}  // namespace swept::inline SWEPT_PRECISION
