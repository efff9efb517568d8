#include "toi_method.h"

#include "brute_force.h"
#include "conservative_advancement.h"
#include "discrete.h"
#include "ray_cast_toi.h"
#include "separating_axis_root.h"
#include "speculative.h"

namespace swept {
namespace {

constexpr bool isInOrder() {
    for (std::size_t i = 0; i < kToiMethods.size(); ++i) {
        if (static_cast<std::size_t>(kToiMethods[i].method) != i) { return false; }
    }
    return true;
}
static_assert(isInOrder(), "the table is looked up by index");

const ToiMethodInfo& infoOf(ToiMethod method) { return kToiMethods[static_cast<std::size_t>(method)]; }

}  // namespace

std::string_view nameOf(ToiMethod method) { return infoOf(method).name; }
std::string_view describe(ToiMethod method) { return infoOf(method).description; }

std::optional<ToiMethod> toiMethodFrom(std::string_view name) {
    for (const ToiMethodInfo& info : kToiMethods) {
        if (info.name == name) { return info.method; }
    }
    return std::nullopt;
}

Toi timeOfImpactBy(ToiMethod method, const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                   const ToiSettings& settings) {
    switch (method) {
        case ToiMethod::discrete:
            return discreteTest(a, sweepA, b, sweepB, settings);
        case ToiMethod::rayCast:
            return rayCastToi(a, sweepA, b, sweepB, settings);
        case ToiMethod::shapeCast:
            return shapeCast(a, sweepA, b, sweepB, settings);
        case ToiMethod::conservativeAdvancement:
            return conservativeAdvancement(a, sweepA, b, sweepB, settings);
        case ToiMethod::bruteForce:
            return bruteForce(a, sweepA, b, sweepB, settings);
        case ToiMethod::separatingAxisRoot:
            return separatingAxisRoot(a, sweepA, b, sweepB, settings);
        case ToiMethod::speculative:
            return speculativeContact(a, sweepA, b, sweepB, settings);
        case ToiMethod::certified:
            return timeOfImpact(a, sweepA, b, sweepB, settings);
    }
    return {};  // unreachable, but GCC cannot know
}

}  // namespace swept
