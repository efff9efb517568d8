#include "camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "scene_source.h"

namespace swept {
namespace {

// As of the numbers of a scene: what single precision can hold.
constexpr double kLargest = 3e38;

/// "0,2.5,10" as three numbers, whatever they are.
std::optional<std::array<double, 3>> threeNumbers(const std::string& text) {
    std::array<double, 3> numbers{};
    const char* at = text.c_str();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        char* end = nullptr;
        numbers[i] = std::strtod(at, &end);
        const char expected = i + 1 < numbers.size() ? ',' : '\0';
        if (end == at || *end != expected) { return std::nullopt; }
        at = end + 1;
    }
    return numbers;
}

std::optional<ViewDescription> parseView(const std::string& text, std::string& error) {
    const auto numbers = threeNumbers(text);
    if (!numbers) {
        error = "--view " + text + ": expected X,Y,HEIGHT in metres, as 0,2.5,10";
        return std::nullopt;
    }
    const auto isInRange = [](double number) { return std::fabs(number) <= kLargest; };
    if (!std::all_of(numbers->begin(), numbers->end(), isInRange)) {
        error = "--view " + text + ": must be finite numbers, at most 3e38";
        return std::nullopt;
    }
    const auto [x, y, height] = *numbers;
    if (!(height >= 1 / kLargest)) {
        error = "--view " + text + ": the height must be greater than 0, by 1/3e38 at least";
        return std::nullopt;
    }
    return ViewDescription{{x, y}, height};
}

}  // namespace

void Camera::applyTo(RenderOptions& options) const {
    options.view = view;
    options.follow = follow;
}

void addCameraArguments(Command command, CameraArguments& arguments) {
    command
        .option(
            "--view", arguments.view,
            "What pictures show, in metres: their middle and height, instead of the scene's view; with --follow X,Y "
            "count from the body")
        .type("X,Y,HEIGHT");
    command
        .option(
            "--follow", arguments.follow,
            "Name of a body that the pictures move with. Without --view it is in their middle, and they are 8 times "
            "as high as it reaches from its origin (at most as the scene's view)")
        .type("BODY");
}

std::optional<Camera> cameraOf(const CameraArguments& arguments, const SceneDescription& scene, std::string& error) {
    Camera camera;
    if (!arguments.view.empty()) {
        camera.view = parseView(arguments.view, error);
        if (!camera.view) { return std::nullopt; }
    }
    if (!arguments.follow.empty()) {
        camera.follow = bodyOfName("--follow", arguments.follow, bodyNames(scene), error);
        if (!camera.follow) { return std::nullopt; }
    }
    return camera;
}

std::string faultWithoutPicture(const std::string& size, const CameraArguments& camera) {
    if (!size.empty()) { return "--size needs --png"; }
    if (!camera.view.empty()) { return "--view needs --png"; }
    return camera.follow.empty() ? "" : "--follow needs --png";
}

}  // namespace swept
