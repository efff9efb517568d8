#pragma once

#include <box2d/box2d.h>
#include <map>
#include <string>

#include <swept/samples/scene_description.h>

namespace swept {

/// Adds a joint of the scene between bodies found by name. @param joints  those that a gear may name
b2Joint* addJoint(b2World& world, const JointDescription& joint, const std::map<std::string, b2Body*>& bodies,
                  const std::map<std::string, b2Joint*>& joints);

/// How far the joint is from what it demands, metres: the anchors' distance, or what a length lies outside its limits.
/// 0 for joints that Box2D does not tell it of: gears and drives.
double jointErrorOf(b2Joint& joint);

/// Whether the joint's last reaction is above what it may bear.
bool breaks(const b2Joint& joint, const JointDescription& description, double dt);

}  // namespace swept
