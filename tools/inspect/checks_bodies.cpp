#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

#include <swept/samples/scene_names.h>
#include <swept/shapes/bounding_circle.h>

#include "../writers/number_text.h"
#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

std::string seconds(double x) { return roundedText(x, 3) + " s"; }

/// A length of a body that users think of: twice its reach.
double sizeOf(const PlacedBody& body) { return 2 * body.reach; }

void checkUnits(const PlacedScene& placed, const PlacedBody& body, std::vector<Finding>& findings) {
    const double gravity = gravityOf(placed, body);
    if (gravity == 0) { return; }
    const double fall = std::sqrt(2 * sizeOf(body) / gravity);
    if (fall >= envelope::kShortestFall && fall <= envelope::kLongestFall) { return; }
    const std::string guess = fall > envelope::kLongestFall ? " (are these pixels?)" : " (are these millimetres?)";
    findings.push_back({Severity::warning, "units", pointerOf(body),
                        body.name + " is " + metres(sizeOf(body)) + " large and takes " + seconds(fall) +
                            " to fall its own size: it will look " +
                            (fall > envelope::kLongestFall ? "slow" : "hectic") + guess,
                        "give lengths in metres (divide pixels by pixels per metre), or scale gravity with them"});
}

void checkAngle(const PlacedBody& body, double angle, const std::string& what, std::vector<Finding>& findings) {
    if (std::fabs(angle) <= kFullTurn || !isMultipleOfFive(angle)) { return; }
    findings.push_back({Severity::note, "degrees", pointerOf(body),
                        body.name + " has " + what + ' ' + roundedText(angle) + " rad, " +
                            roundedText(std::fabs(angle) / kFullTurn, 3) + " turns",
                        "if degrees were meant: " + fromDegrees(angle)});
}

void checkAngles(const PlacedBody& body, std::vector<Finding>& findings) {
    checkAngle(body, body.description->angle, "an angle of", findings);
    for (const ShapeDescription& shape : body.description->shapes) {
        const auto* const box = std::get_if<BoxGeometry>(&shape.geometry);
        if (box != nullptr) { checkAngle(body, box->angle, "a box at an angle of", findings); }
    }
}

void checkStepAgainstSize(const PlacedScene& placed, const PlacedBody& body, std::vector<Finding>& findings) {
    const double gravity = gravityOf(placed, body);
    const double dt = placed.scene->settings.dt;
    if (gravity == 0 || body.extent == 0) { return; }
    const double natural = std::sqrt(body.extent / gravity);
    if (natural >= envelope::kStepsPerNaturalTime * dt) { return; }
    const double hertz = std::ceil(envelope::kStepsPerNaturalTime / natural);
    findings.push_back(
        {Severity::warning, "step-too-long", pointerOf(body),
         body.name + " is " + metres(body.extent) + " thin; under this gravity it falls that far in " +
             seconds(std::sqrt(2.0) * natural) + ", a step is " + seconds(dt) +
             ": stacks of such bodies sink in or topple",
         "--set /settings/dt=" + roundedDownText(1 / hertz, 4) + " (" + roundedText(hertz) + " Hz), or larger bodies"});
}

void checkPlace(const PlacedBody& body, std::vector<Finding>& findings) {
    if (body.extent == 0) { return; }
    const double far = std::max(std::fabs(body.center.x), std::fabs(body.center.y)) + body.reach;
    const double step = far * std::numeric_limits<double>::epsilon();
    if (step > envelope::kToleranceRatio * body.extent) {
        findings.push_back({Severity::warning, "far-away", pointerOf(body),
                            body.name + " is " + metres(far) + " from the origin, where neighbouring doubles are " +
                                metres(step) + " apart: more than the tolerance of its contacts",
                            "move the scene nearer to the origin"});
        return;
    }
    const double boxStep = far * static_cast<double>(std::numeric_limits<float>::epsilon());
    if (boxStep > envelope::kFastRatio * body.extent) {
        findings.push_back({Severity::note, "far-away", pointerOf(body),
                            body.name + " is " + metres(far) + " from the origin: in f32 its box grows by " +
                                metres(boxStep) + " (positions stay exact), so pairs are tested that do not touch",
                            "--precision f64, or move the scene nearer to the origin"});
    }
}

void checkVertices(const PlacedScene& placed, const PlacedPiece& piece, std::vector<Finding>& findings) {
    const Polygon& polygon = piece.polygon;
    if (polygon.count < 3) { return; }
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const auto from = static_cast<std::size_t>(i);
        const auto to = static_cast<std::size_t>(polygon.next(i));
        const double edge = std::sqrt(lengthSquared(polygon.vertices[to] - polygon.vertices[from]));
        shortest = std::min(shortest, edge);
        longest = std::max(longest, edge);
    }
    if (shortest >= envelope::kVertexDistance * longest) { return; }
    const PlacedBody& body = bodyOf(placed, piece);
    // A box has no vertices that could be merged, and is its own smallest edge thick.
    const bool isBox = std::holds_alternative<BoxGeometry>(shapeOf(placed, piece).geometry);
    findings.push_back({Severity::warning, "short-edge", pointerOf(piece),
                        body.name + " has an edge of " + metres(shortest) + " beside one of " + metres(longest) +
                            ": single precision does not resolve its direction",
                        isBox ? "a box less thin (" + metres(envelope::kVertexDistance * longest) +
                                    " or more), a segment with a radius, or --precision f64"
                              : "merge the two vertices, or --precision f64"});
}

void checkAspect(const PlacedScene& placed, const PlacedPiece& piece, std::vector<Finding>& findings) {
    const PlacedBody& body = placed.bodies[static_cast<std::size_t>(piece.body)];
    const double length = 2 * boundingCircle(piece.polygon).radius;
    const double width = piece.extent;
    if (!body.isDynamic() || piece.polygon.count < 2 || length <= envelope::kAspectRatio * width) { return; }
    findings.push_back({Severity::warning, "slender", pointerOf(piece),
                        body.name + " is " + metres(length) + " long and " + metres(width) +
                            " wide, 1 : " + roundedText(length / width, 3),
                        "a larger radius, or several shorter bodies with joints"});
}

/// What is thinnest of all that does not move by itself.
struct Wall {
    double width = std::numeric_limits<double>::infinity();
    std::string body;  ///< empty: there is none
};

Wall thinnestWall(const PlacedScene& placed) {
    Wall thinnest;
    for (const PlacedPiece& piece : placed.pieces) {
        const PlacedBody& body = bodyOf(placed, piece);
        const bool isLine = piece.polygon.count == 2 && piece.polygon.radius == 0;
        const double width = isLine ? 0 : piece.extent;
        if (!body.isDynamic() && !shapeOf(placed, piece).sensor && width < thinnest.width) {
            thinnest = {width, body.name};
        }
    }
    return thinnest;
}

void checkSpeed(const PlacedScene& placed, const PlacedBody& body, const Wall& wall, std::vector<Finding>& findings) {
    if (!body.isDynamic() || body.extent == 0 || modeOf(placed, body) != SceneContinuous::off) { return; }
    const double travel = reachableSpeed(placed, body) * placed.scene->settings.dt;
    if (wall.body.empty() || travel <= 0.5 * (body.extent + wall.width)) { return; }
    findings.push_back({Severity::warning, "tunnelling", pointerOf(body),
                        body.name + " may move " + metres(travel) +
                            " in a step, and nothing sweeps it (continuous: off); it is " + metres(body.extent) +
                            " thick, " + wall.body + " " + metres(wall.width),
                        "\"continuous\": \"subStep\", or walls thicker than " + metres(2 * travel - body.extent)});
}

/// Marked for what its mode does not do.
void checkBullet(const PlacedScene& placed, const PlacedBody& body, std::vector<Finding>& findings) {
    if (!body.isDynamic() || !body.description->bullet || isBullet(placed, body)) { return; }
    const std::string_view mode = namesOf<SceneContinuous>()[static_cast<std::size_t>(modeOf(placed, body))];
    findings.push_back({Severity::note, "bullet-idle", pointerOf(body),
                        body.name + " is a bullet, but its continuous mode is " + std::string(mode) +
                            ": it is not swept against dynamic bodies",
                        "\"continuous\": \"subStep\", or leave the mark out"});
}

}  // namespace

void checkBodies(const PlacedScene& placed, std::vector<Finding>& findings) {
    const Wall wall = thinnestWall(placed);
    for (const PlacedBody& body : placed.bodies) {
        if (body.isDynamic()) {
            checkUnits(placed, body, findings);
            checkStepAgainstSize(placed, body, findings);
        }
        checkPlace(body, findings);
        checkAngles(body, findings);
        checkSpeed(placed, body, wall, findings);
        checkBullet(placed, body, findings);
    }
    for (const PlacedPiece& piece : placed.pieces) {
        checkVertices(placed, piece, findings);
        checkAspect(placed, piece, findings);
    }
}

double gravityOf(const PlacedScene& placed, const PlacedBody& body) {
    const DVec2 g = placed.scene->gravity;
    return length(g) * std::fabs(body.description->gravityScale);
}

SceneContinuous modeOf(const PlacedScene& placed, const PlacedBody& body) {
    return body.description->continuous.value_or(placed.scene->settings.continuous);
}

bool isBullet(const PlacedScene& placed, const PlacedBody& body) {
    return body.isDynamic() && body.description->bullet && modeOf(placed, body) == SceneContinuous::subStep;
}

double reachableSpeed(const PlacedScene& placed, const PlacedBody& body) {
    const double gravity = gravityOf(placed, body);
    const double own = std::max(body.speed, body.drive);
    if (gravity == 0) { return own; }
    // The depth of the fall: along gravity, from the body to the far end of the scene.
    const bool rises = body.description->gravityScale < 0;
    const DVec2 down = ((rises ? -1 : 1) / length(placed.scene->gravity)) * placed.scene->gravity;
    const double reach = placed.farthest[rises ? 1 : 0].reachWithout(body.index);
    const double depth = std::max(0.0, reach - dot(down, body.center));
    return std::sqrt(own * own + 2 * gravity * depth);
}

}  // namespace swept
