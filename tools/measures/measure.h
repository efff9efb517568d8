#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// The measures of error: their names, units and definitions. All are magnitudes, 0 is perfect, less is better.

namespace swept::measures {

enum class Measure : std::size_t {
    penetration,
    meanPenetration,
    jointError,
    energyGain,
    energyDrift,
    momentumDrift,
    lostTime,
    missedHits,
    lateHits,
    restingDrift,
    stackSway,
    eventTime,
    position,
};
inline constexpr std::size_t kMeasureCount = 13;

struct MeasureInfo {
    const char* name;        ///< as on the command line and in CSV: "mean-penetration"
    const char* unit;        ///< "m", "s", "1"
    bool needsReference;     ///< compares with a closed form or a refined run: means nothing where that is chaotic
    const char* definition;  ///< one sentence
};

/// In the order of `Measure`.
std::span<const MeasureInfo, kMeasureCount> allMeasures();
const MeasureInfo& infoOf(Measure measure);
std::optional<Measure> measureNamed(std::string_view name);
/// `; did you mean "penetration"?`, or all names.
std::string suggestionFor(std::string_view name);

/// One number each; NaN where a measure says nothing of a scene or an engine.
class Values {
public:
    Values();
    double& operator[](Measure measure) { return numbers_[static_cast<std::size_t>(measure)]; }
    double operator[](Measure measure) const { return numbers_[static_cast<std::size_t>(measure)]; }

private:
    std::array<double, kMeasureCount> numbers_;
};

}  // namespace swept::measures
