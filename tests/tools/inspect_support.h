#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/inspect/inspect_scene.h>

/// What the suites of the scene doctor's findings share.

namespace swept::inspect_test {

/// Ground and a box of one metre that lies on it: nothing to find.
inline SceneDescription soundScene() {
    SceneDescription scene = build::scene("sound", {0, 2}, 6);
    build::addFixed(scene, "ground", {0, -0.5}, {build::box({10, 0.5})});
    build::addDynamic(scene, "crate", {0, 0.5}, {build::box({0.5, 0.5})});
    return scene;
}

inline int countOf(const Inspection& inspection, const std::string& kind, const std::string& where) {
    return static_cast<int>(std::count_if(inspection.findings.begin(), inspection.findings.end(),
                                          [&](const Finding& f) { return f.kind == kind && f.where == where; }));
}

inline bool needs(const Inspection& inspection, const std::string& feature) {
    for (const Need& need : inspection.needs) {
        if (need.feature == feature) { return need.needed; }
    }
    ADD_FAILURE() << "nothing is said about " << feature;
    return false;
}

/// The scene is what its format allows, and the finding is there once and alone.
inline void expectOnly(const SceneDescription& scene, const std::string& kind, const std::string& where) {
    const auto error = validateScene(scene);
    ASSERT_FALSE(error) << error->text();
    const Inspection inspection = inspectScene(scene);
    EXPECT_EQ(countOf(inspection, kind, where), 1) << kind << " at " << where;
    for (const Finding& finding : inspection.findings) {
        EXPECT_EQ(finding.kind, kind) << finding.where << ": " << finding.text;
        EXPECT_FALSE(finding.text.empty());
        EXPECT_FALSE(finding.remedy.empty());
    }
}

/// The advice on the one finding of this kind; empty, and a failure, without one.
inline std::string remedyOf(const SceneDescription& scene, const std::string& kind) {
    for (const Finding& finding : inspectScene(scene).findings) {
        if (finding.kind == kind) { return finding.remedy; }
    }
    ADD_FAILURE() << "no " << kind;
    return "";
}

}  // namespace swept::inspect_test
