#include <array>
#include <string>
#include <utility>

#include <swept/samples/scene_builder.h>

#include "joint_scenes.h"

namespace swept::worlds {
namespace {

constexpr int kMachines = 100;
constexpr int kLinks = 4;

/// Which meets nothing, so that nothing is solved but joints.
ShapeDescription passing(ShapeDescription shape) {
    shape.filter.mask = 0;
    return shape;
}
std::string addBar(SceneDescription& scene, DVec2 center) {
    build::addDynamic(scene, "", center, {passing(build::box({0.45, 0.1}))});
    return build::lastBody(scene);
}
DVec2 placeOf(int machine) { return {8.0 * (machine % 10), 8.0 * (machine / 10)}; }

/// So many machines, each made by `add(scene, place)` beside the fixed body "ground".
template <class Add>
BenchScene makeMachines(const char* name, double size, const Add& add) {
    BenchScene bench = emptyBench(name, 20, 300);
    build::addFixed(bench.scene, "ground", {0, 0}, {passing(build::box({1, 1}))});
    const int count = scaledCount(kMachines, size);
    for (int i = 0; i < count; ++i) { add(bench.scene, placeOf(i)); }
    return bench;
}

/// Bars end to end that are let go level, the first one at the ground.
/// @param join  called with the scene, two bodies and the point between them
template <class Join>
BenchScene makeChains(const char* name, double size, const Join& join) {
    return makeMachines(name, size, [&join](SceneDescription& scene, DVec2 place) {
        std::string last = "ground";
        for (int k = 0; k < kLinks; ++k) {
            std::string bar = addBar(scene, place + DVec2{k + 0.5, 0});
            join(scene, last, bar, place + DVec2{static_cast<double>(k), 0});
            last = std::move(bar);
        }
    });
}

/// The same of disks, from centre to centre.
template <class Refine>
BenchScene makeRods(const char* name, double size, const Refine& refine) {
    return makeMachines(name, size, [&refine](SceneDescription& scene, DVec2 place) {
        std::string last = "ground";
        for (int k = 0; k < kLinks; ++k) {
            const DVec2 from = place + DVec2{static_cast<double>(k), 0};
            const DVec2 to = from + DVec2{1, 0};
            build::addDynamic(scene, "", to, {passing(build::circle(0.2))});
            std::string disk = build::lastBody(scene);
            refine(build::rod(scene, last, disk, from, to));
            last = std::move(disk);
        }
    });
}

BenchScene makeHinges(double size) { return makeChains("hinges", size, build::hinge); }
BenchScene makeHingesWithLimits(double size) {
    return makeChains("hinges-limits", size, [](SceneDescription& scene, auto& a, auto& b, DVec2 at) {
        RevoluteDescription& hinge = build::hinge(scene, a, b, at);
        hinge.lower = -2.5;
        hinge.upper = 2.5;
    });
}
BenchScene makeHingesWithSprings(double size) {
    return makeChains("hinges-springs", size, [](SceneDescription& scene, auto& a, auto& b, DVec2 at) {
        RevoluteDescription& hinge = build::hinge(scene, a, b, at);
        hinge.hertz = 2;
        hinge.dampingRatio = 0.1;
    });
}
BenchScene makeHingesWithMotors(double size) {
    return makeChains("hinges-motors", size, [](SceneDescription& scene, auto& a, auto& b, DVec2 at) {
        RevoluteDescription& hinge = build::hinge(scene, a, b, at);
        hinge.motorSpeed = 1;
        hinge.maxMotorTorque = 1000;
    });
}

template <bool kIsPointSoft, bool kIsAngleSoft>
BenchScene makeWelds(const char* name, double size) {
    return makeChains(name, size, [](SceneDescription& scene, auto& a, auto& b, DVec2 at) {
        WeldDescription& weld = build::weld(scene, a, b, at);
        if (kIsPointSoft) { weld.linearHertz = 4; }
        if (kIsAngleSoft) { weld.angularHertz = 4; }
        weld.dampingRatio = 0.1;
    });
}
BenchScene makeWeldsSoftInBoth(double size) { return makeWelds<true, true>("welds-soft", size); }
BenchScene makeWeldsSoftInAngle(double size) { return makeWelds<false, true>("welds-angle-soft", size); }
BenchScene makeWeldsSoftInPoint(double size) { return makeWelds<true, false>("welds-point-soft", size); }
/// Thrown, as what hangs on the ground does not move.
BenchScene makeRigidWelds(double size) {
    return makeMachines("welds-rigid", size, [](SceneDescription& scene, DVec2 place) {
        std::string last = addBar(scene, place);
        scene.bodies.back().velocity = {1, 8};
        for (int k = 1; k <= kLinks; ++k) {
            std::string bar = addBar(scene, place + DVec2{static_cast<double>(k), 0});
            build::weld(scene, last, bar, place + DVec2{k - 0.5, 0});
            last = std::move(bar);
        }
    });
}

BenchScene makeRigidRods(double size) {
    return makeRods("rods", size, [](DistanceDescription&) {});
}
BenchScene makeRodSprings(double size) {
    return makeRods("rods-springs", size, [](DistanceDescription& rod) {
        rod.hertz = 2;
        rod.dampingRatio = 0.1;
    });
}
BenchScene makeCables(double size) {
    return makeRods("rods-slack", size, [](DistanceDescription& rod) { rod.maxLength = 1.1; });
}

BenchScene makeSliders(double size) {
    return makeMachines("sliders", size, [](SceneDescription& scene, DVec2 place) {
        const std::string bar = addBar(scene, place);
        PrismaticDescription& slider = build::slider(scene, "ground", bar, place, {0.6, 0.8});
        slider.hertz = 1;
        slider.dampingRatio = 0;
        slider.lower = -20;
        slider.upper = 20;
    });
}

/// In flight.
BenchScene makeCars(double size) {
    return makeMachines("wheels", size, [](SceneDescription& scene, DVec2 place) {
        build::addDynamic(scene, "", place, {passing(build::box({1, 0.25}))}).velocity = {3, 10};
        const std::string chassis = build::lastBody(scene);
        for (const double side : {-0.8, 0.8}) {
            const DVec2 axle = place + DVec2{side, -0.4};
            build::addDynamic(scene, "", axle, {passing(build::circle(0.3))}).velocity = {3, 10};
            WheelDescription& wheel = build::wheel(scene, chassis, build::lastBody(scene), axle, {0, 1});
            wheel.hertz = 4;
            wheel.dampingRatio = 0.3;
            wheel.motorSpeed = -20;
            wheel.maxMotorTorque = 2;
        }
    });
}

/// Brakes of what slides on a floor seen from above.
BenchScene makeMotorJoints(double size) {
    return makeMachines("motor-joints", size, [](SceneDescription& scene, DVec2 place) {
        const std::string bar = addBar(scene, place);
        BodyDescription& body = scene.bodies.back();
        body.gravityScale = 0;
        body.velocity = {5, 1};
        body.angularVelocity = 4;
        MotorDescription& motor = build::motor(scene, "ground", bar);
        motor.linearVelocity = DVec2{0, 0};
        motor.angularVelocity = 0;
        motor.maxForce = 0.3;
        motor.maxTorque = 0.02;
    });
}
BenchScene makeMouseJoints(double size) {
    return makeMachines("mouse-joints", size, [](SceneDescription& scene, DVec2 place) {
        const std::string bar = addBar(scene, place);
        MouseDescription& mouse = build::mouse(scene, "ground", bar, place + DVec2{1, 1});
        mouse.anchor = place + DVec2{0.4, 0};
        mouse.hertz = 2;
        mouse.dampingRatio = 0.1;
        mouse.maxForce = 1000;
    });
}

BenchScene makePulleys(double size) {
    return makeMachines("pulleys", size, [](SceneDescription& scene, DVec2 place) {
        const DVec2 left = place - DVec2{1, 0};
        const DVec2 right = place + DVec2{1, 0};
        const std::string a = addBar(scene, left);
        scene.bodies.back().velocity = {1, 0};
        const std::string b = addBar(scene, right);
        build::pulley(scene, a, b, left, right, place.y + 5);
    });
}
/// Two hinges, which count as well.
BenchScene makeGears(double size) {
    return makeMachines("gears", size, [](SceneDescription& scene, DVec2 place) {
        std::array<std::string, 2> hinges;
        for (std::size_t i = 0; i < hinges.size(); ++i) {
            const DVec2 pivot = place + DVec2{3.0 * static_cast<double>(i), 0};
            const std::string bar = addBar(scene, pivot + DVec2{0.5, 0});
            build::hinge(scene, "ground", bar, pivot);
            hinges[i] = build::lastJoint(scene);
        }
        build::gear(scene, hinges[0], hinges[1], 2);
    });
}

constexpr std::array<SceneEntry, 17> kSortsOfJoints{{
    {"hinges", "chains of four bars that are let go level", false, makeHinges},
    {"hinges-limits", "the same, with limits that are seldom reached", false, makeHingesWithLimits},
    {"hinges-springs", "the same, with springs", false, makeHingesWithSprings},
    {"hinges-motors", "the same, with strong motors", false, makeHingesWithMotors},
    {"rods", "chains of four disks on rods", false, makeRigidRods},
    {"rods-springs", "the same on springs", false, makeRodSprings},
    {"rods-slack", "the same on ropes with a largest length", false, makeCables},
    {"sliders", "bars on a slider with a spring and limits", false, makeSliders},
    {"wheels", "cars in flight, on springs and with motors", false, makeCars},
    {"welds-rigid", "chains of five bars in flight", false, makeRigidWelds},
    {"welds-angle-soft", "chains of four bars, the angle a spring", false, makeWeldsSoftInAngle},
    {"welds-point-soft", "the same, the point a spring", false, makeWeldsSoftInPoint},
    {"welds-soft", "the same, both", false, makeWeldsSoftInBoth},
    {"motor-joints", "bars that a motor joint to the ground brakes", false, makeMotorJoints},
    {"mouse-joints", "bars that swing on a mouse joint", false, makeMouseJoints},
    {"pulleys", "pairs of bars on a pulley", false, makePulleys},
    {"gears", "pairs of bars on hinges with a gear between them", false, makeGears},
}};

}  // namespace

std::span<const SceneEntry> jointScenes() { return kSortsOfJoints; }

}  // namespace swept::worlds
