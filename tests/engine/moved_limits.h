#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "joint_support.h"

namespace swept::test {

/// Platforms on joints of all kinds that have limits or a length, each with a crate on it. Calls move those of every
/// second one.
class MovedLimits {
public:
    World world;

    explicit MovedLimits(Profile profile) : world(worldOf(profile)) {
        const BodyId base = anchorOf(world);
        for (int i = 0; i < kPlatforms; ++i) {
            const DVec2 place{3.0 * i, 0};
            const BodyId platform = addBody(world, dynamicAt(place), box(1, 0.1));
            addBody(world, dynamicAt(place + DVec2{0.3, 0.25}), box(0.15, 0.15));
            joints_.push_back(join(between(base, platform), place, i / 2 % 5));
        }
    }

    /// A step, and what calls move before it.
    void step() {
        const Real way = real(0.4 * (1 - std::cos(0.02 * ++steps_)));
        for (int i = 0; i < kPlatforms; i += 2) {
            const JointId joint = joints_[static_cast<std::size_t>(i)];
            switch (i / 2 % 5) {
                case 0:
                    must(world.setAngleLimits(joint, AngleLimits{way, 1}));
                    break;
                case 1:
                case 2:
                    must(world.setTranslationLimits(joint, TranslationLimits{way, real(1) + way}));
                    break;
                case 3:
                    must(world.setLength(joint, kLong - way));
                    break;
                default:
                    must(world.setLengthLimits(joint, LengthLimits{0, kLong - way}));
                    break;
            }
        }
        must(world.step(kStep));
    }

private:
    static constexpr int kPlatforms = 40;
    static constexpr Real kLong = 5;

    static World worldOf(Profile profile) {
        WorldSettings settings = awakeSettings();
        settings.profile = profile;
        return makeWorld(settings);
    }

    JointId join(const JointDef& base, DVec2 place, int kind) {
        switch (kind) {
            case 0: {
                RevoluteJointDef hinge{base, place - DVec2{1, 0}};
                hinge.limits = AngleLimits{0, 1};
                return must(world.createJoint(hinge));
            }
            case 1: {
                PrismaticJointDef slider{base, place, {0, 1}};
                slider.limits = TranslationLimits{0, 1};
                return must(world.createJoint(slider));
            }
            case 2: {
                WheelJointDef wheel{base, place, {0, 1}};
                wheel.limits = TranslationLimits{0, 1};
                return must(world.createJoint(wheel));
            }
            default: {
                DistanceJointDef rod{base, place + DVec2{0, static_cast<double>(kLong)}, place};
                if (kind == 4) { rod.limits = LengthLimits{0, kLong}; }
                return must(world.createJoint(rod));
            }
        }
    }

    std::vector<JointId> joints_;
    int steps_ = 0;
};

}  // namespace swept::test
