#include "inspect_scene.h"

#include <algorithm>

#include "checks.h"

namespace swept {

Inspection inspectScene(const SceneDescription& scene) {
    const PlacedScene placed = place(scene);
    Inspection inspection;
    const bool needsDouble = checkRefusals(scene, inspection.findings);
    checkBodies(placed, inspection.findings);
    checkPassing(placed, inspection.findings);
    checkPairs(placed, inspection.findings);
    checkChains(placed, inspection.findings);
    checkJoints(placed, inspection.findings);
    std::stable_sort(inspection.findings.begin(), inspection.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    inspection.needs = needsOf(placed);
    if (needsDouble) { inspection.needs.back() = {"f64", true, "f32 refuses the scene"}; }
    return inspection;
}

}  // namespace swept
