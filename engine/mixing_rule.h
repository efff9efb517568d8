#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace swept {

/// What a pair of shapes makes of the friction, or the restitution, of each. Where the two ask for different rules, the
/// one that stands later here holds, whichever of them asks for it: `usual` gives way to every other.
enum class MixingRule : std::uint8_t {
    usual,          ///< `geometricMean` of friction, `maximum` of restitution
    geometricMean,  ///< √(ab)
    average,        ///< (a + b)/2
    minimum,
    product,
    maximum,
};

/// What `usual` stands for.
inline constexpr MixingRule kUsualFriction = MixingRule::geometricMean;
inline constexpr MixingRule kUsualRestitution = MixingRule::maximum;

/// @param usual  what that rule stands for: another one
constexpr MixingRule ruleOfPair(MixingRule a, MixingRule b, MixingRule usual) {
    const MixingRule later = (std::max)(a, b);
    return later == MixingRule::usual ? usual : later;
}

/// Of two numbers of at least 0, whose product is none too large. The same with both swapped.
/// @param rule  any but `usual`
template <class Number>
Number mixed(MixingRule rule, Number a, Number b) {
    assert(rule != MixingRule::usual && "it stands for another one");
    switch (rule) {
        case MixingRule::usual:
            break;
        case MixingRule::geometricMean:
            return std::sqrt(a) * std::sqrt(b);  // unlike the root of the product it cannot overflow
        case MixingRule::average:
            return (a + b) / 2;
        case MixingRule::minimum:
            return (std::min)(a, b);
        case MixingRule::product:
            return a * b;
        case MixingRule::maximum:
            return (std::max)(a, b);
    }
    return 0;  // unreachable, but GCC cannot know
}

/// Of two surfaces that touch: `Surface`, `ShapeDef`, or what has the same members.
template <class Kind>
auto mixedFriction(const Kind& a, const Kind& b) {
    return mixed(ruleOfPair(a.frictionMixing, b.frictionMixing, kUsualFriction), a.friction, b.friction);
}
template <class Kind>
auto mixedRestitution(const Kind& a, const Kind& b) {
    return mixed(ruleOfPair(a.restitutionMixing, b.restitutionMixing, kUsualRestitution), a.restitution, b.restitution);
}

}  // namespace swept
