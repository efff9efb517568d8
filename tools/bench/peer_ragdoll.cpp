#include "peer_ragdoll.h"

#include <array>

namespace swept::bench {
namespace {

constexpr std::uint32_t kGround = 1;  // categories
constexpr std::uint32_t kBone = 2;
constexpr float kPi = 3.14159265F;
constexpr float kFrictionTorque = 0.05F;  // N·m

/// Heights are above the soles, of the body and of the hinge to its parent; metres.
struct Bone {
    int parent;
    float height;
    float low, high;  // ends of the capsule, from the body
    float radius;
    float hinge;
    float lower, upper;  // angles, in π
    float friction;      // share of the torque
    float damping;
    bool hasFoot;
};

constexpr int kNone = -1;
constexpr std::array<Bone, 11> kBones = {{
    {kNone, 0.95F, -0.02F, 0.02F, 0.095F, 0, 0, 0, 1, 0, false},                          // 0 hip
    {0, 1.2F, -0.135F, 0.135F, 0.09F, 1.0F, -0.25F, 0, 0.5F, 0, false},                   // 1 torso
    {1, 1.475F, -0.038F, 0.039F, 0.075F, 1.4F, -0.3F, 0.1F, 0.25F, 0.1F, false},          // 2 head
    {0, 0.775F, -0.125F, 0.125F, 0.06F, 0.9F, -0.05F, 0.4F, 1, 0, false},                 // 3, 5 thighs
    {3, 0.475F, -0.155F, 0.125F, 0.045F, 0.625F, -0.5F, -0.02F, 0.5F, 0, true},           // 4, 6 shanks
    {0, 0.775F, -0.125F, 0.125F, 0.06F, 0.9F, -0.05F, 0.4F, 1, 0, false},
    {5, 0.475F, -0.155F, 0.125F, 0.045F, 0.625F, -0.5F, -0.02F, 0.5F, 0, true},
    {1, 1.225F, -0.125F, 0.125F, 0.035F, 1.35F, -0.1F, 0.8F, 0.5F, 0, false},             // 7, 9 upper arms
    {7, 0.975F, -0.125F, 0.125F, 0.03F, 1.1F, -0.2F, 0.3F, 0.1F, 0.1F, false},            // 8, 10 forearms
    {1, 1.225F, -0.125F, 0.125F, 0.035F, 1.35F, -0.1F, 0.8F, 0.5F, 0, false},
    {9, 0.975F, -0.125F, 0.125F, 0.03F, 1.1F, -0.2F, 0.3F, 0.1F, 0.1F, false},
}};

PeerBody bodyOf(const Bone& bone, DVec2 position, int group) {
    constexpr float kFootRadius = 0.015F;
    constexpr std::array<Vec2, 4> kFoot = {{{-0.03F, -0.185F}, {0.11F, -0.185F}, {0.11F, -0.16F}, {-0.03F, -0.14F}}};
    PeerBody body;
    body.def.type = BodyType::dynamic;
    body.def.position = {position.x, position.y + static_cast<double>(bone.height)};
    body.def.linearDamping = bone.damping;
    ShapeDef shape;
    shape.friction = 0.2F;
    shape.filter = {kBone, kGround | kBone, -group};
    body.shapes.push_back({makeCapsule({0, bone.low}, {0, bone.high}, bone.radius).value(), shape});
    if (bone.hasFoot) {
        shape.filter = {kBone, kGround, 0};
        body.shapes.push_back({makePolygon(kFoot, kFootRadius).value(), shape});
    }
    return body;
}

}  // namespace

std::vector<std::uint32_t> addRagdoll(PeerWorld& world, DVec2 position, int group) {
    std::vector<std::uint32_t> bodies;
    for (const Bone& bone : kBones) {
        bodies.push_back(world.addBody(bodyOf(bone, position, group)));
        if (bone.parent == kNone) { continue; }
        PeerHinge hinge;
        hinge.a = bodies[static_cast<std::size_t>(bone.parent)];
        hinge.b = bodies.back();
        hinge.anchor = {position.x, position.y + static_cast<double>(bone.hinge)};
        hinge.limits = AngleLimits{bone.lower * kPi, bone.upper * kPi};
        hinge.motor = AngularMotor{0, bone.friction * kFrictionTorque};
        hinge.spring = Spring{5, 0.5F};
        world.addHinge(hinge);
    }
    return bodies;
}

}  // namespace swept::bench
