#include <gtest/gtest.h>

#include <string>

#include "render_support.h"

namespace swept {
namespace {

using test::bareOptions;
using test::makeBody;
using test::picture;

/// Two bodies beside each other, with the names "a" and one of two.
Image namedPicture(double apart, const std::string& second) {
    SceneDescription scene;
    scene.bodies = {makeBody(SceneBodyType::fixed, {0, 0}, test::circle(0.5)),
                    makeBody(SceneBodyType::fixed, {apart, 0}, test::circle(0.5))};
    scene.bodies[0].name = "a";
    scene.bodies[1].name = second;
    RenderOptions options = bareOptions();
    options.labels = true;
    return picture(scene, options);
}

TEST(RenderNames, AreWrittenOnlyWhereAskedFor) {
    SceneDescription scene;
    scene.bodies = {makeBody(SceneBodyType::fixed, {0, 0}, test::circle(0.5))};
    RenderOptions options = bareOptions();
    const Image bare = picture(scene, options);
    options.labels = true;
    const Image unnamed = picture(scene, options);
    EXPECT_FALSE(unnamed == bare) << "body0";
    scene.bodies[0].name = "ball";
    EXPECT_FALSE(picture(scene, options) == unnamed);
    scene.bodies[0].position = {100, 0};
    options.labels = false;
    const Image empty = picture(scene, options);
    options.labels = true;
    EXPECT_TRUE(picture(scene, options) == empty) << "nobody is in sight";
}

TEST(RenderNames, AreNotWrittenOnEachOther) {
    EXPECT_FALSE(namedPicture(2, "b") == namedPicture(2, "c"));
    EXPECT_TRUE(namedPicture(0.05, "b") == namedPicture(0.05, "c")) << "the earlier one is there";
}

}  // namespace
}  // namespace swept
