#include <limits>

#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

int subStepsOf(const SettingsDescription& settings) {
    return settings.subSteps.value_or(settings.profile == SceneProfile::accurate ? 16 : 4);
}

}  // namespace

double iteratedMassRatio(const PlacedScene& placed, const PlacedBody& light, double size) {
    const double gravity = gravityOf(placed, light);
    if (!(gravity > 0)) { return std::numeric_limits<double>::infinity(); }
    const double h = placed.scene->settings.dt / subStepsOf(placed.scene->settings);
    return envelope::kMostGive * size / (envelope::kSpringGive * gravity * h * h);
}

bool solvesAtOnce(const PlacedScene& placed) {
    const SettingsDescription& settings = placed.scene->settings;
    return settings.profile == SceneProfile::accurate && subStepsOf(settings) >= envelope::kFewestSubSteps;
}

std::string massRemedy(const PlacedScene& placed, double most) {
    const bool isFast = placed.scene->settings.profile == SceneProfile::fast;
    return "masses within a factor of " + roundedText(most, 2) + (isFast ? ", profile accurate" : "") +
           ", or more /settings/subSteps (the error falls with their square)";
}

}  // namespace swept
