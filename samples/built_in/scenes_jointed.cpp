#include "../scene_builder.h"
#include "builtin_scenes.h"

/// Bodies held together by joints.

namespace swept::scenes {
namespace {

using namespace build;

constexpr double kDollScale = 1.4;

// Everything of one doll: its parts are named after it and do not collide with each other (one negative group).
class DollBuilder {
public:
    DollBuilder(SceneDescription& scene, std::string name, int group, DVec2 feet)
        : scene_(scene), name_(std::move(name)), group_(group), feet_(feet) {}

    void build() {
        limb("torso", {0, 1.02}, {0, 1.42}, 0.15);
        addDynamic(scene_, name_ + " head", world({0, 1.76}), {circle(0.13 * kDollScale)}).shapes[0].filter.group =
            -group_;
        limit(hinge(scene_, name_ + " torso", name_ + " head", world({0, 1.6})), -0.5, 0.5);
        for (const double side : {-1.0, 1.0}) {
            const std::string which = side < 0 ? "left " : "right ";
            limb(which + "arm", {0.2 * side, 1.45}, {0.46 * side, 1.45}, 0.06);
            limb(which + "hand", {0.5 * side, 1.45}, {0.76 * side, 1.45}, 0.05);
            limb(which + "thigh", {0.09 * side, 0.92}, {0.09 * side, 0.58}, 0.08);
            limb(which + "shin", {0.09 * side, 0.5}, {0.09 * side, 0.1}, 0.06);
            joint("torso", which + "arm", {0.17 * side, 1.45}, -1.6, 1.6);
            joint("torso", which + "thigh", {0.09 * side, 0.96}, -0.7, 1.3);
            joint(which + "thigh", which + "shin", {0.09 * side, 0.54}, -2.2, 0);
            // An elbow bends to one side only: forwards, which turns the two arms in opposite senses.
            joint(which + "arm", which + "hand", {0.48 * side, 1.45}, side < 0 ? -2.3 : 0, side < 0 ? 0 : 2.3);
        }
    }

private:
    DVec2 world(DVec2 point) const { return feet_ + kDollScale * point; }

    void limb(const std::string& part, DVec2 p, DVec2 q, double radius) {
        addLimb(scene_, name_ + " " + part, world(p), world(q), kDollScale * radius).shapes[0].filter.group = -group_;
    }

    static void limit(RevoluteDescription& hinge, double lower, double upper) {
        hinge.lower = lower;
        hinge.upper = upper;
    }

    void joint(const std::string& a, const std::string& b, DVec2 anchor, double lower, double upper) {
        limit(hinge(scene_, name_ + " " + a, name_ + " " + b, world(anchor)), lower, upper);
    }

    SceneDescription& scene_;
    std::string name_;
    int group_;
    DVec2 feet_;
};

}  // namespace

SceneDescription newtonsCradle() {
    SceneDescription scene = build::scene("Newton's cradle", {0.2, 3.5}, 9);
    addFixed(scene, "beam", {-2.2, 6.6}, {box({3.2, 0.15})});
    addFixed(scene, "hook", {5.4, 4.2}, {circle(0.1)});
    constexpr double kRadius = 0.45;
    for (int i = 0; i < 5; ++i) {
        const DVec2 top{-4 + 2.002 * kRadius * i, 6.45};  // a hair apart, so that they collide one after the other
        // The first ball is lifted: a 3-4-5 triangle keeps its rod exactly as long as the others.
        const DVec2 ball = top + (i == 0 ? DVec2{-2.7, -3.6} : DVec2{0, -4.5});
        addDynamic(scene, "ball" + std::to_string(i), ball, {withFriction(withRestitution(circle(kRadius), 1), 0)});
        rod(scene, "beam", lastBody(scene), top, ball);
    }
    const DVec2 hook{5.4, 4.2};  // out of reach of the last ball
    const DVec2 elbow = hook + DVec2{1.4, 0};
    addLimb(scene, "upper", hook, elbow, 0.12);
    hinge(scene, "hook", "upper", hook);
    addLimb(scene, "lower", elbow, elbow + DVec2{0, 1.1}, 0.12);
    hinge(scene, "upper", "lower", elbow);
    return scene;
}

SceneDescription ragdolls() {
    SceneDescription scene = build::scene("ragdolls", {0, 3.6}, 10.4);
    std::vector<ShapeDescription> stairs{box({9.2, 0.2}, {0, -0.2}), box({0.2, 1.5}, {8.6, 1.5})};
    for (int step = 0; step < 6; ++step) {
        const double height = 0.6 * (step + 1);
        stairs.push_back(box({0.7, height / 2}, {-0.3 - 1.4 * step, height / 2}));
    }
    addFixed(scene, "stairs", {0, 0}, std::move(stairs));
    for (int i = 0; i < 4; ++i) {
        const DVec2 feet{-7.2 + 2.4 * i, 5.4 - 0.3 * i};
        const std::size_t first = scene.bodies.size();
        DollBuilder(scene, "doll" + std::to_string(i), i + 1, feet).build();
        for (std::size_t part = first; part < scene.bodies.size(); ++part) {
            scene.bodies[part].velocity = {2.0 + 0.5 * i, 1};
        }
    }
    return scene;
}

SceneDescription hangingChain() {
    SceneDescription scene = build::scene("hanging chain", {0.1, 3.3}, 10);
    addFixed(scene, "floor", {0, 0}, {box({9, 0.2}, {0, -0.2})});
    addFixed(scene, "hook", {-4, 7}, {circle(0.12)});
    addFixed(scene, "posts", {0, 0}, {box({0.2, 1.5}, {-0.2, 1.5}), box({0.2, 1.5}, {8.2, 1.5})});

    // The chain starts level and swings down; the ball weighs about thirty links.
    std::string holder = "hook";
    for (int i = 0; i < 10; ++i) {
        const DVec2 p{-4 - 0.34 * i, 7};
        const DVec2 q = p - DVec2{0.34, 0};
        addLimb(scene, "link" + std::to_string(i), p, q, 0.06);
        hinge(scene, holder, lastBody(scene), p);
        holder = lastBody(scene);
    }
    const DVec2 end{-4 - 3.4, 7};
    addDynamic(scene, "weight", end - DVec2{0.4, 0}, {withDensity(circle(0.4), 4)});
    hinge(scene, holder, "weight", end);

    // The bridge: planks from post to post, hinged where they meet.
    std::string before = "posts";
    constexpr int kPlanks = 16;
    for (int i = 0; i < kPlanks; ++i) {
        addDynamic(scene, "plank" + std::to_string(i), {0.25 + 0.5 * i, 2.9}, {withDensity(box({0.24, 0.06}), 4)});
        hinge(scene, before, lastBody(scene), {0.5 * i, 2.9});
        before = lastBody(scene);
    }
    hinge(scene, before, "posts", {0.5 * kPlanks, 2.9});
    for (int i = 0; i < 5; ++i) {
        addDynamic(scene, "load" + std::to_string(i), {1.6 + 1.2 * i, 4.2 + 0.3 * i},
                   {i % 2 == 0 ? box({0.3, 0.3}) : circle(0.3)});
    }
    return scene;
}

}  // namespace swept::scenes
