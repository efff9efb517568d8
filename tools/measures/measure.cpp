#include "measure.h"

#include <array>
#include <limits>

#include <swept/samples/scene_names.h>

namespace swept::measures {
namespace {

constexpr std::array<MeasureInfo, kMeasureCount> kMeasures{{
    {"penetration", "m", false, "deepest overlap of two shapes that may collide, at any sample"},
    {"mean-penetration", "m", false, "mean over the samples of the deepest overlap at each"},
    {"joint-error", "m", false, "largest gap by which a joint failed to hold, after any step"},
    {"energy-gain", "1", false, "largest rise of the energy above its least value before, as a part of what there was"},
    {"energy-drift", "1", false, "largest distance of the energy from that at the start, as a part of it"},
    {"momentum-drift", "1", false, "largest distance of the momentum from what gravity makes of it, as a part of it"},
    {"lost-time", "s", false, "time that one body was not moved, of the body that lost most"},
    {"missed-hits", "1", false,
     "impacts on static and kinematic shapes that the certified time of impact foresees and "
     "that left no trace in the motion"},
    {"late-hits", "s", false,
     "longest time from an impact that is foreseen so to the end of the sample in which "
     "nothing was done about it"},
    {"resting-drift", "m", true, "way in the last quarter of the run of a body that rests there in the reference"},
    {"stack-sway", "m", true, "largest sideways distance from its start of a body that stays there in the reference"},
    {"event-time", "s", true,
     "largest difference of the times at which a body first meets something static or "
     "kinematic"},
    {"position", "m", true, "largest distance of a body from its place in the reference, at any sample"},
}};

std::array<std::string_view, kMeasureCount> names() {
    std::array<std::string_view, kMeasureCount> result;
    for (std::size_t i = 0; i < kMeasureCount; ++i) { result[i] = kMeasures[i].name; }
    return result;
}

}  // namespace

std::span<const MeasureInfo, kMeasureCount> allMeasures() { return kMeasures; }

const MeasureInfo& infoOf(Measure measure) { return kMeasures[static_cast<std::size_t>(measure)]; }

std::optional<Measure> measureNamed(std::string_view name) {
    for (std::size_t i = 0; i < kMeasureCount; ++i) {
        if (kMeasures[i].name == name) { return static_cast<Measure>(i); }
    }
    return std::nullopt;
}

std::string suggestionFor(std::string_view name) {
    const auto known = names();
    return suggestion(name, known);
}

Values::Values() { numbers_.fill(std::numeric_limits<double>::quiet_NaN()); }

}  // namespace swept::measures
