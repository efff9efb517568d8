#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "joint_support.h"

/// A tank: a hull on five wheels, and around these a track of hinged links. Its links are light, and stand between
/// wheels that press on them and the ground.

namespace swept::test {
namespace {

constexpr double kWheel = 0.4;                 ///< radius, m
constexpr double kTrack = kWheel + 0.085;      ///< from the axles to the hinges of the track
constexpr double kWheelbase = 4;               ///< from the first axle to the last one
constexpr double kHalfLink = 0.054;            ///< half of the thickness of a link
constexpr double kAxleHeight = 0.15 + kWheel;  ///< where it begins, and falls a little
constexpr double kWall = 4;                    ///< x, ahead of it
constexpr double kFront = kWheelbase / 2 + kTrack + kHalfLink;

AngularMotor motor(double speed, double torque) { return {.speed = real(speed), .maxTorque = real(torque)}; }

struct Tank {
    World world;
    BodyId hull{};
    std::vector<BodyId> parts{};
    std::vector<JointId> axles{};
    double lost = 0;  ///< s

    void go(double seconds) {
        for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
            run(world, 1);
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
        }
    }

    void drive(double speed, double torque) {
        for (const JointId axle : axles) { must(world.setAngularMotor(axle, motor(speed, torque))); }
    }

    bool isAsleep() const {
        return std::none_of(parts.begin(), parts.end(), [this](BodyId part) { return world.isAwake(part); });
    }
};

/// Along the line of the hinges, clockwise from above the first axle.
DVec2 placeOnTrack(double way) {
    const double arc = kPi * kTrack;
    const double whole = 2 * (kWheelbase + arc);
    way = std::fmod(way, whole);
    const bool isBack = way >= whole / 2;
    const double rest = isBack ? way - whole / 2 : way;
    const double angle = std::max(rest - kWheelbase, 0.0) / kTrack;
    const DVec2 place{std::min(rest, kWheelbase) - kWheelbase / 2 + kTrack * std::sin(angle), kTrack * std::cos(angle)};
    return DVec2{0, kAxleHeight} + (isBack ? -place : place);
}

ShapeDef part(double friction, double density, std::uint32_t category, std::uint32_t mask) {
    ShapeDef def = material(friction, 0, density);
    def.filter.category = category;
    def.filter.mask = mask;
    return def;
}

void addTrack(Tank& tank, int links, double rub) {
    const double step = 2 * (kWheelbase + kPi * kTrack) / links;
    std::vector<BodyId> track;
    for (int i = 0; i < links; ++i) {
        const DVec2 from = placeOnTrack(i * step);
        const DVec2 along = placeOnTrack((i + 1) * step) - from;
        const BodyDef def = bodyAt(BodyType::dynamic, from + 0.5 * along, std::atan2(along.y, along.x));
        track.push_back(addBody(tank.world, def, box(length(along) / 2, kHalfLink), part(1, 100, 8, 1 | 4)));
    }
    for (int i = 0; i < links; ++i) {
        RevoluteJointDef hinge;
        const std::size_t next = static_cast<std::size_t>(i + 1) % track.size();
        hinge.base = between(track[static_cast<std::size_t>(i)], track[next]);
        hinge.anchor = placeOnTrack((i + 1) * step);
        const JointId joint = must(tank.world.createJoint(hinge));
        if (rub > 0) { must(tank.world.setAngularMotor(joint, motor(0, rub))); }
    }
    tank.parts.insert(tank.parts.end(), track.begin(), track.end());
}

/// @param rub  friction of each hinge of the track, N·m
Tank makeTank(Profile profile, int links, double rub) {
    WorldSettings settings;
    settings.profile = profile;
    Tank tank{makeWorld(settings)};
    const BodyId ground = must(tank.world.createBody({}));
    const std::vector<Vec2> corner{vec(kWall, 20), vec(kWall, 0), vec(-20, 0), vec(-20, 20)};
    must(tank.world.addChain(ground, corner, false, material(0.9)));
    tank.hull = addBody(tank.world, dynamicAt({0, 0.5 + kAxleHeight}), box(2.2, 0.25), part(0.6, 200, 2, 1));
    tank.parts.push_back(tank.hull);
    for (int i = 0; i < 5; ++i) {
        const DVec2 center{i * kWheelbase / 4 - kWheelbase / 2, kAxleHeight};
        const BodyId wheel = addBody(tank.world, dynamicAt(center), circle(kWheel), part(1, 100, 4, 8));
        RevoluteJointDef axle;
        axle.base = between(tank.hull, wheel);
        axle.anchor = center;
        tank.axles.push_back(must(tank.world.createJoint(axle)));
        tank.parts.push_back(wheel);
    }
    addTrack(tank, links, rub);
    return tank;
}

/// In `fast` a link under a wheel, or between wheel and wall, sinks in as deep as it may, and was told to lose the
/// whole of each step while it stood there.
TEST(TrackedVehicle, LosesNoTimeWhereItIsPressedToAWall) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const int links : {40, 44}) {
            Tank tank = makeTank(profile, links, 0);
            tank.go(3);
            tank.drive(-8, 400);
            tank.go(4);
            const std::string which =
                (profile == Profile::fast ? "fast, " : "accurate, ") + std::to_string(links) + " links";
            EXPECT_NEAR(tank.world.position(tank.hull).x, kWall - kFront, 0.15) << which;
            tank.lost = 0;
            tank.go(4);
            EXPECT_LT(tank.lost, 0.01) << which;
            EXPECT_NEAR(tank.world.position(tank.hull).x, kWall - kFront, 0.15) << which;
        }
    }
}

/// Hinges that rub (a motor without speed) take the energy of a track that swings between its wheels.
TEST(TrackedVehicle, SleepsWhereTheHingesOfItsTrackRub) {
    for (const int links : {40, 44}) {
        Tank tank = makeTank(Profile::accurate, links, 3);
        tank.go(6);
        EXPECT_TRUE(tank.isAsleep()) << links << " links";
        tank.drive(-8, 400);
        tank.go(3);
        tank.drive(0, 1000);
        tank.go(9);
        EXPECT_TRUE(tank.isAsleep()) << links << " links, at the wall";
    }
}

}  // namespace
}  // namespace swept::test
