#include "toi_families.h"

#include <algorithm>
#include <cmath>

#include "toi_case_parts.h"

namespace swept {
namespace {

using namespace cases;

struct Sizes {
    double a = 1;
    double b = 1;
};

/// Two random polygons approaching each other.
ToiQuery pairOf(Dice& dice, Sizes sizes, const Approach& how, double aspect = 1, int low = 1, int high = 8) {
    ToiQuery q;
    q.a = randomPolygon(dice, sizes.a, aspect, low, high);
    q.b = randomPolygon(dice, sizes.b, aspect, low, high);
    approach(dice, q, sizes.a, sizes.b, how);
    return q;
}

Sizes usualSizes(Dice& dice, double unit = 1) { return {unit, unit * dice.range(0.2, 1)}; }

ToiQuery generic(Dice& dice, double unit = 1) { return pairOf(dice, usualSizes(dice, unit), {}); }

ToiQuery graze(Dice& dice) {
    ToiQuery q = pairOf(dice, usualSizes(dice), {.travel = 4, .miss = 1, .turns = chance(dice, 0.5) ? 0.125 : 0.5});
    q.settings = defaultToiSettings(q.a, q.b);
    const double levels[] = {0, q.settings.target, q.settings.target - q.settings.tolerance};
    const double level = levels[integer(dice, 0, 2)];
    const double size = 1024 * q.settings.target;  // the pair's extent
    passAt(q, level + sign(dice) * size * logRange(dice, 1e-6, 1e-3));
    return q;
}

ToiQuery spin(Dice& dice) {
    const double turns = logRange(dice, 0.1, 20);
    return pairOf(dice, usualSizes(dice), {.distance = dice.range(0.7, 1.2), .travel = 1, .turns = turns},
                  dice.range(0.02, 0.1), 2, 8);
}

/// The plane is the upper face of A, seen with a random turn and drift, as A or as B.
void presentPlane(Dice& dice, ToiQuery& q) {
    turnScene(q, dice.range(0, kTurn));
    drift(q, dice.range(0, 2) * direction(dice));
    if (chance(dice, 0.5)) { swapBodies(q); }
}

ToiQuery caWorst(Dice& dice) {
    ToiQuery q;
    q.a = box({0, -1}, {dice.range(2, 50), 1});
    // The centre of mass is the vertex at the bottom; the first of the others comes down on the plane.
    const double lowest = dice.range(0.1, 1.2);
    const double other = lowest + dice.range(0.3, 1.2);
    const double far = dice.range(0.5, 2);
    const double near = dice.range(0.3, 1) * far;
    q.b.count = 3;
    q.b.vertices[1] = {far * std::cos(lowest), far * std::sin(lowest)};
    q.b.vertices[2] = {near * std::cos(other), near * std::sin(other)};
    q.sweepB.c0 = q.sweepB.c1 = {dice.range(-0.5, 0.5), logRange(dice, 2e-3, 0.1)};
    q.sweepB.a1 = -dice.range(0.3, 1.1) * (lowest + 0.5);
    if (chance(dice, 0.3)) { q.sweepB.c1.y += dice.range(-0.02, 0.1); }
    presentPlane(dice, q);
    return q;
}

ToiQuery sliver(Dice& dice) {
    return pairOf(dice, usualSizes(dice), {.travel = 4, .turns = 0.25}, logRange(dice, 1e-6, 1e-1), 2, 8);
}

ToiQuery tinyHuge(Dice& dice) {
    const Sizes sizes{logRange(dice, 10, 1e4), logRange(dice, 1e-4, 1e-1)};
    ToiQuery q = pairOf(dice, sizes, {.distance = 1.2, .travel = chance(dice, 0.5) ? 1 : 0.1});
    if (chance(dice, 0.5)) { startAt(q, sizes.b * logRange(dice, 1e-1, 1e2)); }
    if (chance(dice, 0.5)) { swapBodies(q); }
    return q;
}

ToiQuery shortEdge(Dice& dice) {
    const Sizes sizes = usualSizes(dice);
    ToiQuery q;
    q.a = withCutCorner(dice, randomPolygon(dice, sizes.a, 1, 3, 7), logRange(dice, 1e-6, 1e-2));
    q.b = withCutCorner(dice, randomPolygon(dice, sizes.b, 1, 3, 7), logRange(dice, 1e-6, 1e-2));
    approach(dice, q, sizes.a, sizes.b, {});
    return q;
}

ToiQuery far(Dice& dice) {
    ToiQuery q = generic(dice);
    const DVec2 origin = logRange(dice, 1e3, 1e6) * direction(dice);
    for (Sweep* sweep : {&q.sweepA, &q.sweepB}) {
        sweep->c0 += origin;
        sweep->c1 += origin;
    }
    return q;
}

ToiQuery overlap(Dice& dice) {
    return pairOf(dice, usualSizes(dice), {.distance = dice.range(0, 0.5), .turns = 0.5}, 1, 2, 8);
}

ToiQuery touch(Dice& dice) {
    const Sizes sizes = usualSizes(dice);
    ToiQuery q = pairOf(dice, sizes, {.travel = 1});
    startAt(q, chance(dice, 0.3) ? 0 : sign(dice) * sizes.b * logRange(dice, 1e-12, 1e-6));
    q.settings = defaultToiSettings(q.a, q.b);
    const double below = separationAtFraction(q, 0) - 2 * q.settings.tolerance;
    if (chance(dice, 0.5) && below + q.a.radius + q.b.radius >= 0) { q.settings.target = below; }
    return q;
}

ToiQuery atTarget(Dice& dice) {
    ToiQuery q = pairOf(dice, usualSizes(dice), {.travel = 1});
    q.settings = defaultToiSettings(q.a, q.b);
    const double aside = chance(dice, 0.25) ? 0 : dice.range(-3, 3);
    startAt(q, q.settings.target + aside * q.settings.tolerance);
    return q;
}

ToiQuery faceFace(Dice& dice) {
    ToiQuery q;
    const DVec2 half{dice.range(0.1, 1), dice.range(0.05, 1)};
    q.a = box({0, -1}, {dice.range(0.5, 10), 1});
    q.b = box({}, half);
    if (chance(dice, 0.3)) { q.b.radius = half.y * dice.range(0.01, 0.5); }
    q.sweepB.c0 = {dice.range(-2, 2), half.y + q.b.radius + half.y * logRange(dice, 1e-2, 3)};
    q.sweepB.c1 = q.sweepB.c0 + DVec2{dice.range(-1, 1), -half.y * dice.range(0, 4)};
    const double turn = chance(dice, 0.5) ? 0 : sign(dice) * logRange(dice, 1e-8, 1e-2);
    q.sweepB.a1 = turn;
    if (chance(dice, 0.5)) { q.sweepA.a1 = chance(dice, 0.5) ? turn : sign(dice) * logRange(dice, 1e-8, 1e-2); }
    presentPlane(dice, q);
    return q;
}

ToiQuery fast(Dice& dice) {
    const double sizesPerStep = logRange(dice, 1e2, 1e5);
    return pairOf(dice, usualSizes(dice), {.distance = 0.5 * sizesPerStep, .travel = sizesPerStep, .miss = 1});
}

/// B above a face of A; for a moment in the middle of the step it is deeper than before and after.
ToiQuery dip(Dice& dice) {
    ToiQuery q;
    q.a = box({0, -1}, {dice.range(0.5, 4), 1});
    const double depth = sign(dice) * logRange(dice, 1e-5, 0.1);  // negative: it stays as much above
    if (chance(dice, 0.3)) {                                      // thrown from below the horizon of its parabola
        q.b = randomPolygon(dice, 0.5, dice.range(0.2, 1));
        q.sweepB.c0 = {dice.range(-0.3, 0.3), 3};
        q.sweepB.c1 = {dice.range(-0.3, 0.3), 3};
        q.sweepB.a0 = dice.range(0, kTurn);
        q.sweepB.a1 = q.sweepB.a0 + dice.range(-0.1, 0.1);
        q.sweepB.k = {0, dice.range(0.5, 12)};
        passAt(q, -depth);
    } else {  // a long corner swings through the lowest point
        const double reach = dice.range(0.5, 1.5);
        const double half = dice.range(0.01, 0.2) * reach;
        const double swing = dice.range(0.6, 5);
        q.b.count = 3;
        q.b.vertices[0] = {0, -reach};
        q.b.vertices[1] = {half, 0};
        q.b.vertices[2] = {-half, 0};
        q.sweepB.c0 = q.sweepB.c1 = {dice.range(-0.3, 0.3), reach - depth};
        q.sweepB.a0 = -swing * dice.range(0.3, 0.7);
        q.sweepB.a1 = q.sweepB.a0 + swing;
        if (chance(dice, 0.5)) { std::swap(q.sweepB.a0, q.sweepB.a1); }
    }
    presentPlane(dice, q);
    return q;
}

ToiQuery bothTurning(Dice& dice) {
    ToiQuery q = pairOf(dice, usualSizes(dice), {.distance = 1.4, .travel = 1.5, .turns = 0});
    for (Sweep* sweep : {&q.sweepA, &q.sweepB}) { sweep->a1 = sweep->a0 + sign(dice) * kTurn * dice.range(0.1, 1); }
    return q;
}

ToiQuery circlesCapsules(Dice& dice) {
    const Sizes sizes = usualSizes(dice);
    ToiQuery q = pairOf(dice, sizes, {.turns = 0.5}, 1, 1, 2);
    q.a.radius = sizes.a * logRange(dice, 1e-3, 1);
    q.b.radius = sizes.b * logRange(dice, 1e-3, 1);
    return q;
}

ToiQuery parabola(Dice& dice) {
    const double turns = chance(dice, 0.3) ? 0 : 0.3;
    return pairOf(dice, usualSizes(dice), {.travel = 2, .turns = turns, .acceleration = 8});
}

ToiQuery offCenter(Dice& dice) {
    return pairOf(dice, usualSizes(dice), {.distance = 3, .travel = 8, .turns = 0.5, .localCenter = 2});
}

ToiQuery make(ToiFamily family, Dice& dice) {
    switch (family) {
        case ToiFamily::generic:
            return generic(dice);
        case ToiFamily::graze:
            return graze(dice);
        case ToiFamily::spin:
            return spin(dice);
        case ToiFamily::caWorst:
            return caWorst(dice);
        case ToiFamily::sliver:
            return sliver(dice);
        case ToiFamily::tinyHuge:
            return tinyHuge(dice);
        case ToiFamily::shortEdge:
            return shortEdge(dice);
        case ToiFamily::far:
            return far(dice);
        case ToiFamily::overlap:
            return overlap(dice);
        case ToiFamily::touch:
            return touch(dice);
        case ToiFamily::atTarget:
            return atTarget(dice);
        case ToiFamily::faceFace:
            return faceFace(dice);
        case ToiFamily::fast:
            return fast(dice);
        case ToiFamily::dip:
            return dip(dice);
        case ToiFamily::bothTurning:
            return bothTurning(dice);
        case ToiFamily::circlesCapsules:
            return circlesCapsules(dice);
        case ToiFamily::parabola:
            return parabola(dice);
        case ToiFamily::offCenter:
            return offCenter(dice);
        case ToiFamily::small:
            return generic(dice, 1e-9);
        case ToiFamily::large:
            return generic(dice, 1e9);
    }
    return {};  // unreachable, but GCC cannot know
}

bool isAccepted(const ToiQuery& q) { return validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings).ok(); }

}  // namespace

std::string_view nameOf(ToiFamily family) {
    switch (family) {
        case ToiFamily::generic:
            return "generic";
        case ToiFamily::graze:
            return "graze";
        case ToiFamily::spin:
            return "spin";
        case ToiFamily::caWorst:
            return "ca_worst";
        case ToiFamily::sliver:
            return "sliver";
        case ToiFamily::tinyHuge:
            return "tiny_huge";
        case ToiFamily::shortEdge:
            return "short_edge";
        case ToiFamily::far:
            return "far";
        case ToiFamily::overlap:
            return "overlap";
        case ToiFamily::touch:
            return "touch";
        case ToiFamily::atTarget:
            return "at_target";
        case ToiFamily::faceFace:
            return "face_face";
        case ToiFamily::fast:
            return "fast";
        case ToiFamily::dip:
            return "dip";
        case ToiFamily::bothTurning:
            return "both_turning";
        case ToiFamily::circlesCapsules:
            return "circles_capsules";
        case ToiFamily::parabola:
            return "parabola";
        case ToiFamily::offCenter:
            return "off_center";
        case ToiFamily::small:
            return "small";
        case ToiFamily::large:
            return "large";
    }
    return "";  // unreachable, but GCC cannot know
}

std::optional<ToiFamily> toiFamilyFrom(std::string_view name) {
    const auto found = std::find_if(kToiFamilies.begin(), kToiFamilies.end(),
                                    [name](ToiFamily family) { return nameOf(family) == name; });
    return found == kToiFamilies.end() ? std::nullopt : std::optional(*found);
}

ToiQuery makeToiCase(ToiFamily family, std::uint64_t seed, std::uint64_t index) {
    // Multiplied by odd numbers, neighbouring seeds, indices and families start far apart in the generator's one cycle.
    Dice dice(seed * 0xD1342543DE82EF95U + index * 0xAF251AF3B0F025B5U +
              static_cast<std::uint64_t>(family) * 0x9E6C63D0876A9A63U);
    ToiQuery q = make(family, dice);
    if (!(q.settings.tolerance > 0)) { q.settings = defaultToiSettings(q.a, q.b); }
    if (chance(dice, 0.1)) { q.settings.tMax = dice.range(0.1, 1); }
    if (chance(dice, 0.3)) {  // down to a millionth of the extent, where double can resolve it
        const double usual = q.settings.tolerance;
        q.settings.tolerance = usual * logRange(dice, 1.0 / 256, 1);
        if (!isAccepted(q)) { q.settings.tolerance = usual; }
    }
    while (!isAccepted(q) && q.settings.tolerance < q.settings.target) { q.settings.tolerance *= 2; }
    return q;
}

}  // namespace swept
