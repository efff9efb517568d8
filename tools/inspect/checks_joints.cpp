#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <swept/samples/joint_start.h>
#include <swept/samples/scene_reader.h>

#include "../writers/number_text.h"
#include "assemblies.h"
#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

/// A rod may miss its length by this part of it before the first step pulls visibly.
constexpr double kLengthSlack = 1e-3;
/// Part of the smaller body's reach by which anchors may be apart.
constexpr double kGapSlack = 1e-2;
/// Part of its way by which a joint may begin beyond its limits, as one does that was pressed against them.
constexpr double kLimitSlack = 1e-2;

std::string pointerOf(std::size_t joint) { return "/joints/" + std::to_string(joint); }

struct Ends {
    const PlacedBody* a = nullptr;
    const PlacedBody* b = nullptr;
};

Ends endsOf(const PlacedScene& placed, const JointDescription& joint) {
    const auto at = [&](int i) { return i < 0 ? nullptr : &placed.bodies[static_cast<std::size_t>(i)]; };
    return {at(bodyNamed(placed, joint.bodyA)), at(bodyNamed(placed, joint.bodyB))};
}

void checkEnds(const PlacedScene& placed, std::size_t i, const Ends& ends, std::vector<Finding>& findings) {
    if (ends.a->isDynamic() || ends.b->isDynamic()) { return; }
    findings.push_back({Severity::note, "joint-idle", pointerOf(i),
                        jointName(*placed.scene, i) + " joins " + ends.a->name + " and " + ends.b->name +
                            ", neither of them dynamic: it moves nothing",
                        "make one of them dynamic, or leave the joint out"});
}

/// Range of lengths that a distance joint allows; a spring has no say, it only pulls.
struct LengthRange {
    double least = 0;
    double most = 0;
};
LengthRange rangeOf(const DistanceDescription& rod) {
    const double initial = length(rod.anchorB - rod.anchorA);
    const double rest = rod.length.value_or(initial);
    if (rod.minLength || rod.maxLength) {
        return {rod.minLength.value_or(0), rod.maxLength.value_or(std::numeric_limits<double>::infinity())};
    }
    return rod.hertz ? LengthRange{0, std::numeric_limits<double>::infinity()} : LengthRange{rest, rest};
}

/// The member that keeps the anchors from where they are: of limits the one that is passed, as a length beyond them is
/// refused.
std::string memberToSet(const DistanceDescription& rod, bool isShort) {
    if (isShort && rod.minLength) { return "\"minLength\""; }
    return !isShort && rod.maxLength ? "\"maxLength\"" : "\"length\"";
}

void checkLength(const PlacedScene& placed, std::size_t i, const Ends& ends, const DistanceDescription& rod,
                 std::vector<Finding>& findings) {
    const double initial = length(rod.anchorB - rod.anchorA);
    const LengthRange range = rangeOf(rod);
    const double missing = std::max(range.least - initial, initial - range.most);
    if (missing <= kLengthSlack * std::max(initial, range.least)) { return; }
    const bool isHopeless = !ends.a->isDynamic() && !ends.b->isDynamic();
    const bool isShort = initial < range.least;
    const bool isLimit = range.least != range.most;
    findings.push_back(
        {Severity::warning, isHopeless ? "joint-impossible" : "joint-violated", pointerOf(i),
         jointName(*placed.scene, i) + " wants its anchors " + (isLimit ? (isShort ? "at least " : "at most ") : "") +
             metres(isShort ? range.least : range.most) + " apart, they start " + metres(initial) + " apart" +
             (isHopeless ? " on bodies that it cannot move" : ": the first steps pull them together hard"),
         "place the bodies so that the anchors fit, or set " + memberToSet(rod, isShort) + ": " +
             roundedText(initial)});
}

/// @param start  where it begins
/// @param unit   of what the limits limit
/// @param from   the member that tells where that is 0
template <class LimitedJoint>
void checkLimits(const PlacedScene& placed, std::size_t i, const LimitedJoint& joint, double start, const char* unit,
                 const char* from, std::vector<Finding>& findings) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double lower = joint.lower.value_or(-kInfinity);
    const double upper = joint.upper.value_or(kInfinity);
    const double slack = kLimitSlack * std::fabs(start);  // limits that hold give way a little
    if (lower - slack <= start && start <= upper + slack) { return; }
    findings.push_back({Severity::warning, "joint-violated", pointerOf(i),
                        jointName(*placed.scene, i) + " starts at " + roundedText(start) + ' ' + unit +
                            ", outside its limits " + roundedText(lower) + " … " + roundedText(upper) + ' ' + unit,
                        "limits count from the initial pose, or from the \"" + std::string(from) +
                            "\": let them include " + roundedText(start)});
}

double angleAtStart(const Ends& ends, const RevoluteDescription& hinge) {
    const double apart = ends.b->description->angle - ends.a->description->angle;
    return apart - referenceAngleOf(hinge, apart);
}

double reachOf(const Ends& ends) {
    double reach = std::numeric_limits<double>::infinity();
    for (const PlacedBody* const body : {ends.a, ends.b}) {
        if (body->isDynamic() && body->reach > 0) { reach = std::min(reach, body->reach); }
    }
    return reach;
}

/// Anchors that belong together, or on a line.
template <class Members>
void checkGap(const PlacedScene& placed, std::size_t i, const Ends& ends, const Members& joint,
              std::vector<Finding>& findings) {
    const DVec2 apart = joint.anchorB.value_or(joint.anchor) - joint.anchor;
    double gap = length(apart);
    if constexpr (requires { joint.axis; }) { gap = std::fabs(cross(joint.axis, apart)) / length(joint.axis); }
    if (gap <= kGapSlack * reachOf(ends)) { return; }
    findings.push_back({Severity::warning, "joint-violated", pointerOf(i),
                        jointName(*placed.scene, i) + " starts " + metres(gap) +
                            " from where it holds: the first steps pull it together hard",
                        "place the bodies so that the anchors fit, unless it is to snap together"});
}

/// All that a hinge is given must be multiples of five, and one of them beyond a turn: a winch may have many turns.
void checkHingeAngles(const PlacedScene& placed, std::size_t i, const RevoluteDescription& hinge,
                      std::vector<Finding>& findings) {
    std::string given;
    std::string meant;
    bool isBeyond = false;
    const auto add = [&](const char* member, const std::optional<double>& angle) {
        if (!angle) { return true; }
        isBeyond = isBeyond || std::fabs(*angle) > kFullTurn;
        const std::string key = std::string(given.empty() ? "" : ", ") + member + ' ';
        given += key + roundedText(*angle);
        meant += key + fromDegrees(*angle);
        return isMultipleOfFive(*angle);
    };
    const bool areUsual =
        add("lower", hinge.lower) && add("upper", hinge.upper) && add("springTarget", hinge.springTarget);
    if (!areUsual || !isBeyond) { return; }
    findings.push_back({Severity::note, "degrees", pointerOf(i),
                        jointName(*placed.scene, i) + " has " + given + " rad, beyond a turn of 6.283",
                        "if degrees were meant: " + meant});
}

double weightOf(const PlacedScene& placed, const PlacedBody& body) {
    const BodyDescription& given = placed.scene->bodies[static_cast<std::size_t>(body.index)];
    return body.mass * std::fabs(given.gravityScale) * length(placed.scene->gravity);
}

/// A body that hangs on one joint alone must not weigh more than that can hold, or pull.
void checkStrength(const PlacedScene& placed, std::size_t i, const Ends& ends, std::vector<Finding>& findings) {
    const JointDescription& joint = placed.scene->joints[i];
    const auto* const mouse = std::get_if<MouseDescription>(&joint.joint);
    const std::optional<double> most = mouse != nullptr ? mouse->maxForce : joint.breakForce;
    const bool isHanging = mouse != nullptr ? ends.b->isDynamic() : ends.a->isDynamic() != ends.b->isDynamic();
    if (!most || !isHanging) { return; }
    const PlacedBody& body = ends.b->isDynamic() ? *ends.b : *ends.a;
    const double weight = weightOf(placed, body);
    if (weight <= *most || body.joints > 1) { return; }
    findings.push_back(
        {Severity::note, "joint-weak", pointerOf(i),
         jointName(*placed.scene, i) + (mouse != nullptr ? " pulls with " : " breaks at ") + roundedText(*most, 3) +
             " N, and " + body.name + " alone weighs " + roundedText(weight, 3) + " N",
         std::string(mouse != nullptr ? "a \"maxForce\"" : "a \"breakForce\"") + " of several times the weight"});
}

/// Two rods from one body to things that do not move: four lengths of a closed linkage must be able to close.
void checkRodPairs(const PlacedScene& placed, std::vector<Finding>& findings) {
    struct Rod {
        std::size_t joint;
        int body;
        DVec2 fixedAnchor, bodyAnchor;
        double length;
    };
    std::vector<Rod> rods;
    std::map<int, std::vector<std::size_t>> rodsOf;  // by body
    for (std::size_t i = 0; i < placed.scene->joints.size(); ++i) {
        const auto* rod = std::get_if<DistanceDescription>(&placed.scene->joints[i].joint);
        const Ends ends = endsOf(placed, placed.scene->joints[i]);
        if (rod == nullptr || ends.a->isDynamic() == ends.b->isDynamic()) { continue; }
        const LengthRange range = rangeOf(*rod);
        if (range.least == range.most) {
            const bool bMoves = ends.b->isDynamic();
            rodsOf[bMoves ? ends.b->index : ends.a->index].push_back(rods.size());
            rods.push_back({i, bMoves ? ends.b->index : ends.a->index, bMoves ? rod->anchorA : rod->anchorB,
                            bMoves ? rod->anchorB : rod->anchorA, range.most});
        }
    }
    for (std::size_t i = 0; i < rods.size(); ++i) {
        for (const std::size_t k : rodsOf[rods[i].body]) {
            if (k <= i) { continue; }
            const double frame = length(rods[k].fixedAnchor - rods[i].fixedAnchor);
            const double coupler = length(rods[k].bodyAnchor - rods[i].bodyAnchor);
            const double sum = frame + coupler + rods[i].length + rods[k].length;
            const double longest = std::max(std::max(frame, coupler), std::max(rods[i].length, rods[k].length));
            if (2 * longest > sum * (1 + kLengthSlack)) {
                findings.push_back({Severity::warning, "joint-impossible", pointerOf(rods[k].joint),
                                    jointName(*placed.scene, rods[k].joint) + " and " +
                                        jointName(*placed.scene, rods[i].joint) +
                                        " cannot both keep their lengths: the linkage of " + metres(frame) + ", " +
                                        metres(rods[i].length) + ", " + metres(coupler) + " and " +
                                        metres(rods[k].length) + " does not close",
                                    "lengths of which none is more than the sum of the others"});
            }
        }
    }
}

/// What joints tie together.
struct Machine {
    const PlacedBody* heavy = nullptr;
    const PlacedBody* light = nullptr;
    int bodies = 0;
    int joints = 0;  ///< those to what does not move included
};

/// By root; where there is no dynamic body, empty.
std::vector<Machine> machinesOf(const PlacedScene& placed) {
    Assemblies assemblies(placed.bodies.size());
    for (const JointDescription& joint : placed.scene->joints) {
        const Ends ends = endsOf(placed, joint);
        if (ends.a->isDynamic() && ends.b->isDynamic()) { assemblies.join(ends.a->index, ends.b->index); }
    }
    std::vector<Machine> machines(placed.bodies.size());
    const auto machineOf = [&](const PlacedBody& body) -> Machine& {
        return machines[static_cast<std::size_t>(assemblies.rootOf(body.index))];
    };
    for (const PlacedBody& body : placed.bodies) {
        if (!(body.mass > 0)) { continue; }
        Machine& machine = machineOf(body);
        machine.heavy = machine.heavy == nullptr || body.mass > machine.heavy->mass ? &body : machine.heavy;
        machine.light = machine.light == nullptr || body.mass < machine.light->mass ? &body : machine.light;
        ++machine.bodies;
    }
    for (const JointDescription& joint : placed.scene->joints) {
        const Ends ends = endsOf(placed, joint);
        if (ends.a->isDynamic() || ends.b->isDynamic()) { ++machineOf(ends.a->isDynamic() ? *ends.a : *ends.b).joints; }
    }
    return machines;
}

void checkMasses(const PlacedScene& placed, std::vector<Finding>& findings) {
    for (const Machine& machine : machinesOf(placed)) {
        if (machine.heavy == nullptr || machine.joints == 0) { continue; }
        const PlacedBody& heavy = *machine.heavy;
        const PlacedBody& light = *machine.light;
        const bool isTree = machine.joints <= machine.bodies;
        const bool isDirect = solvesAtOnce(placed) && (isTree || machine.bodies <= envelope::kMostLoopBodies);
        const double most = isDirect ? envelope::kDirectMassRatio : iteratedMassRatio(placed, light, 2 * light.reach);
        if (heavy.mass <= most * light.mass) { continue; }
        findings.push_back({Severity::warning, "mass-ratio", pointerOf(heavy),
                            heavy.name + " (" + roundedText(heavy.mass, 3) + " kg) hangs together with " + light.name +
                                " (" + roundedText(light.mass, 3) + " kg), " + roundedText(heavy.mass / light.mass, 3) +
                                " times lighter: the joints stretch",
                            massRemedy(placed, most)});
    }
}

}  // namespace

void checkJoints(const PlacedScene& placed, std::vector<Finding>& findings) {
    for (std::size_t i = 0; i < placed.scene->joints.size(); ++i) {
        const JointDescription& joint = placed.scene->joints[i];
        const Ends ends = endsOf(placed, joint);
        checkEnds(placed, i, ends, findings);
        if (const auto* rod = std::get_if<DistanceDescription>(&joint.joint)) {
            checkLength(placed, i, ends, *rod, findings);
        }
        if (const auto* weld = std::get_if<WeldDescription>(&joint.joint)) {
            if (!weld->linearHertz) { checkGap(placed, i, ends, *weld, findings); }
        }
        if (const auto* hinge = std::get_if<RevoluteDescription>(&joint.joint)) {
            checkGap(placed, i, ends, *hinge, findings);
            checkLimits(placed, i, *hinge, angleAtStart(ends, *hinge), "rad", "referenceAngle", findings);
            checkHingeAngles(placed, i, *hinge, findings);
        }
        if (const auto* slider = std::get_if<PrismaticDescription>(&joint.joint)) {
            checkGap(placed, i, ends, *slider, findings);
            checkLimits(placed, i, *slider, translationAtStart(*slider), "m", "anchor", findings);
        }
        if (const auto* wheel = std::get_if<WheelDescription>(&joint.joint)) {
            checkGap(placed, i, ends, *wheel, findings);
            checkLimits(placed, i, *wheel, translationAtStart(*wheel), "m", "anchor", findings);
        }
        checkStrength(placed, i, ends, findings);
    }
    checkRodPairs(placed, findings);
    checkMasses(placed, findings);
}

}  // namespace swept
