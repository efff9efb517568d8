#include "motor_work.h"

#include <cmath>
#include <limits>
#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

double workOf(const AngularMotor& motor, double time) {
    return static_cast<double>(motor.maxTorque) * std::fabs(static_cast<double>(motor.speed)) * time;
}
double workOf(const LinearMotor& motor, double time) {
    return static_cast<double>(motor.maxForce) * std::fabs(static_cast<double>(motor.speed)) * time;
}

struct MostWork {
    double time;  ///< s

    double operator()(const JointPart<MotorJointDef, MotorConstraint>& part) const {
        const MotorDrive& drive = part.def.drive;
        double work = 0;
        if (drive.maxForce && *drive.maxForce > 0) {
            if (!drive.linearVelocity) { return kUnknown; }
            work += static_cast<double>(*drive.maxForce) * static_cast<double>(length(*drive.linearVelocity)) * time;
        }
        if (drive.maxTorque && *drive.maxTorque > 0) {
            if (!drive.angularVelocity) { return kUnknown; }
            work += workOf(AngularMotor{.speed = *drive.angularVelocity, .maxTorque = *drive.maxTorque}, time);
        }
        return work;
    }
    template <class Part>
    double operator()(const Part& part) const {
        if constexpr (requires { part.def.motor.has_value() && part.def.spring.has_value(); }) {
            if (!part.def.motor) { return 0; }
            return part.def.spring ? kUnknown : workOf(*part.def.motor, time);
        } else {
            return kUnknown;
        }
    }
};

}  // namespace

double mostWorkOf(const Joint& joint, double time) { return std::visit(MostWork{time}, joint.parts); }

}  // namespace swept::inline SWEPT_PRECISION
