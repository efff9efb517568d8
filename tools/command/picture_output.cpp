#include "picture_output.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <swept/samples/render/contact_sheet.h>
#include <swept/samples/render/image_png.h>
#include <swept/samples/render/image_webp.h>
#include <swept/samples/render/render_canvas.h>
#include <swept/samples/render/render_overlay.h>
#include <swept/samples/render/scene_renderer.h>

#include "../writers/number_text.h"

namespace swept {
namespace {

constexpr const char* kDefaultSize = "1280x720";
constexpr int kSmallestSide = 16;   // pixels
constexpr int kSmallestTile = 240;  // pixels; below that nothing is recognised
constexpr int kMostTiles = 400;
constexpr int kSheetMargin = 2;  // the sheet is about so many pictures wide

constexpr const char* kSheetName = "sheet.png";

std::string sheetPath(const PictureArguments& arguments) { return arguments.directory + '/' + kSheetName; }

/// "frame_000120.png", as `picturePath` calls it.
std::string pictureName(std::int64_t step) {
    std::string number = std::to_string(step);
    constexpr std::size_t kDigits = 6;
    if (number.size() < kDigits) { number.insert(0, kDigits - number.size(), '0'); }
    return "frame_" + number + ".png";
}

/// The step whose picture has this name; nothing for another name.
std::optional<std::int64_t> stepOfPicture(const std::string& name) {
    const std::size_t digits = name.find_first_of("0123456789");
    std::int64_t step = 0;
    if (digits == std::string::npos) { return std::nullopt; }
    (void)std::from_chars(name.data() + digits, name.data() + name.size(), step);
    return pictureName(step) == name ? std::optional(step) : std::nullopt;
}

/// A sheet of N pictures in full size would be huge: tiles shrink with their number.
PictureSize tileSize(PictureSize size, int count) {
    const double columns = std::ceil(std::sqrt(static_cast<double>(count)));
    const double shrink = std::min(1.0, std::max(kSheetMargin / columns, double{kSmallestTile} / size.width));
    return {std::max(kSmallestSide, static_cast<int>(std::lround(shrink * size.width))),
            std::max(kSmallestSide, static_cast<int>(std::lround(shrink * size.height)))};
}

RenderOptions renderOptions(const PictureArguments& arguments, const Camera& camera, PictureSize size) {
    RenderOptions options;
    camera.applyTo(options);
    options.width = size.width;
    options.height = size.height;
    options.trails = arguments.trails;
    options.contacts = arguments.contacts;
    options.velocities = arguments.velocities;
    options.ghosts = arguments.ghosts;
    options.sweeps = arguments.sweeps;
    options.labels = arguments.labels;
    return options;
}

class Pictures final : public PictureOutput {
public:
    Pictures(const PictureArguments& arguments, StepSpan span, double dt)
        : arguments_(arguments), span_(span), dt_(dt) {}

    bool create(const SceneDescription& scene, const Camera& camera, PictureSize size, std::string& error) {
        renderer_ = SceneRenderer::create(scene, renderOptions(arguments_, camera, size), error);
        if (!renderer_) { return false; }
        if (!arguments_.webp.empty()) { webp_.emplace(); }
        if (arguments_.sheet == 0) { return true; }
        sheetSteps_ = sheetSteps(span_, arguments_.sheet);
        const auto moments = static_cast<int>(sheetSteps_.size());  // a short run has fewer than asked for
        RenderOptions tile = renderOptions(arguments_, camera, tileSize(size, moments));
        tile.time = false;                 // that is the caption
        tile.title = tile.legend = false;  // those are said once
        sheetTexts_ = {scene.name, legendEntries(scene, tile)};
        tileRenderer_ = SceneRenderer::create(scene, tile, error);
        return tileRenderer_ != nullptr;
    }

    bool wantsContacts() const override { return arguments_.contacts || arguments_.ghosts; }

    bool show(const Frame& frame, std::span<const SceneEvent> events, std::string& error) override {
        for (SceneRenderer* const renderer : {renderer_.get(), tileRenderer_.get()}) {
            if (renderer != nullptr) { noteStep(*renderer, frame, events); }
        }
        if (span_.includes(frame.step, everyStep()) && !drawFrame(frame, error)) { return false; }
        if (std::binary_search(sheetSteps_.begin(), sheetSteps_.end(), frame.step)) {
            tiles_.push_back(tileRenderer_->draw(frame));
            captions_.push_back(timeLabel(frame.time, dt_));
        }
        return true;
    }

    bool finish(std::string& error) override {
        const int pause = std::max(1, static_cast<int>(std::lround(1000 * dt_ * static_cast<double>(everyStep()))));
        if (webp_ && !webp_->finish(arguments_.webp, lastMs_ + pause, error)) { return failOf("--webp ", error); }
        if (tiles_.empty()) { return true; }
        const std::optional<Image> sheet = contactSheet(tiles_, captions_, 0, error, sheetTexts_);
        return (sheet && writePng(*sheet, sheetPath(arguments_), error)) || failOf("--sheet: ", error);
    }

private:
    /// The error of a picture says which option asked for it. @return false
    static bool failOf(const char* flag, std::string& error) {
        error = flag + error;
        return false;
    }

    std::int64_t everyStep() const { return arguments_.every.value_or(1); }

    void noteStep(SceneRenderer& renderer, const Frame& frame, std::span<const SceneEvent> events) const {
        if (arguments_.trails && span_.includes(frame.step)) { renderer.addTrail(frame); }
        renderer.removeBrokenJoints(events);
    }

    bool drawFrame(const Frame& frame, std::string& error) {
        const bool wantsPng = !arguments_.directory.empty();
        if (!wantsPng && !webp_) { return true; }
        const Image image = renderer_->draw(frame);
        if (wantsPng && !writePng(image, picturePath(arguments_.directory, frame.step), error)) {
            return failOf("--png ", error);
        }
        if (!webp_) { return true; }
        // Times rise strictly even where steps are shorter than a millisecond: then the animation is in slow motion.
        const double seconds = static_cast<double>(frame.step - span_.first) * dt_;
        lastMs_ = std::max(lastMs_ + 1, static_cast<int>(std::lround(1000 * seconds)));
        webp_->add(image, lastMs_);  // a refused picture is reported by `finish`
        return true;
    }

    PictureArguments arguments_;
    StepSpan span_;
    double dt_;
    std::unique_ptr<SceneRenderer> renderer_;
    std::unique_ptr<SceneRenderer> tileRenderer_;
    std::optional<WebpWriter> webp_;
    int lastMs_ = -1;
    std::vector<std::int64_t> sheetSteps_;
    std::vector<Image> tiles_;
    std::vector<std::string> captions_;
    SheetTexts sheetTexts_;
};

/// Animations count in milliseconds.
void warnOfSlowMotion(const PictureArguments& arguments, StepSpan span, double dt) {
    const double pause = 1000 * dt * static_cast<double>(arguments.every.value_or(1));
    const bool isMoving = span.last - span.first >= arguments.every.value_or(1);
    if (arguments.webp.empty() || !isMoving || pause > 0.999) { return; }
    std::cerr << "swept: warning: --webp: pictures " << roundedText(pause) << " ms apart are shown for 1 ms each, "
              << roundedText(1 / pause, 3) << " times as long as they took; --every "
              << roundedText(std::ceil(0.001 / dt), 9) << " shows real time\n";
}

/// The first option that was given of those that say how to draw; null: none was.
const char* drawingOption(const PictureArguments& arguments) {
    const std::pair<const char*, bool> options[] = {
        {"--trails", arguments.trails},
        {"--contacts", arguments.contacts},
        {"--velocities", arguments.velocities},
        {"--ghosts", arguments.ghosts},
        {"--sweeps", arguments.sweeps},
        {"--labels", arguments.labels},
        {"--every", arguments.every.has_value()},
        {"--size", !arguments.size.empty()},
        {"--view", !arguments.camera.view.empty()},
        {"--follow", !arguments.camera.follow.empty()},
    };
    const auto given = std::find_if(std::begin(options), std::end(options), [](const auto& o) { return o.second; });
    return given == std::end(options) ? nullptr : given->first;
}

/// What is wrong with the arguments themselves; empty when nothing is.
std::string faultOf(const PictureArguments& arguments, double duration) {
    if (arguments.every.value_or(1) < 1) { return "--every: must be at least 1"; }
    if (arguments.sheet > 0 && arguments.directory.empty()) {
        return "--sheet: needs --png DIR, into which it writes sheet.png";
    }
    std::error_code ignored;
    if (arguments.directory.ends_with(".png") && !std::filesystem::is_directory(arguments.directory, ignored)) {
        return "--png " + arguments.directory +
               ": is a directory for pictures, frame_000000.png and so on; leave out \".png\"";
    }
    if (const std::string fault = endingFault("--webp", arguments.webp, "WebP"); !fault.empty()) { return fault; }
    const bool draws = !arguments.directory.empty() || !arguments.webp.empty();
    if (const char* const option = drawingOption(arguments); !draws && option != nullptr) {
        return std::string(option) + " needs --png or --webp";
    }
    if (!arguments.webp.empty() && duration * 1000 > std::numeric_limits<int>::max() / 2.0) {
        return "--webp: the run is too long for an animation";
    }
    return "";
}

/// Pictures in the directory that the run has not drawn.
std::int64_t olderPictures(const PictureArguments& arguments, StepSpan span) {
    std::int64_t count = 0;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(arguments.directory, ignored)) {
        const auto step = stepOfPicture(entry.path().filename().string());
        count += step && !span.includes(*step, arguments.every.value_or(1)) ? 1 : 0;
    }
    return count;
}

}  // namespace

void addPictureArguments(Command command, PictureArguments& arguments) {
    command.option("--png", arguments.directory, "Directory for pictures, frame_<step>.png").type("DIR");
    command.option("--every", arguments.every, "Steps from one picture to the next [1]").type("N");
    command.option("--size", arguments.size, "Size of the pictures in pixels [1280x720]").type("WxH");
    addCameraArguments(command, arguments.camera);
    command.option("--webp", arguments.webp, "Animation of the pictures, in real time").type("FILE");
    command.option("--sheet", arguments.sheet, "N moments of the run in one picture, sheet.png in the --png directory")
        .type("N")
        .within(1, kMostTiles);
    command.flag("--trails", arguments.trails, "Draw where the bodies have been");
    command.flag("--contacts", arguments.contacts, "Draw contact points and normals");
    command.flag("--velocities", arguments.velocities, "Draw velocity vectors");
    command.flag("--sweeps", arguments.sweeps,
                 "Draw the last step: what moved, its impacts and their normals, lost time, what it cost");
    command.flag("--ghosts", arguments.ghosts, "Draw the bodies where they met something within the step");
    command.flag("--labels", arguments.labels,
                 "Write the names of the bodies at their origins, as far as there is room");
}

std::string endingFault(const std::string& flag, const std::string& path, const std::string& format) {
    const auto lower = [](std::string text) {
        for (char& c : text) { c = static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
        return text;
    };
    const std::string wanted = '.' + lower(format);
    const std::string ending = std::filesystem::path(path).extension().string();
    if (ending.empty() || lower(ending) == wanted) { return ""; }
    return flag + ' ' + path + ": writes " + format + ", a name that ends in " + wanted + " or has no ending";
}

bool parseSize(const std::string& text, PictureSize& size, std::string& error) {
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool hasCross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = hasCross ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!hasCross || height.ec != std::errc() || height.ptr != end) {
        error = "--size " + text + ": expected WIDTHxHEIGHT in pixels, as 1280x720";
        return false;
    }
    const auto isInRange = [](int side) { return side >= kSmallestSide && side <= kLargestPicture; };
    if (isInRange(size.width) && isInRange(size.height)) { return true; }
    error = "--size " + text + ": sides must be between " + std::to_string(kSmallestSide) + " and " +
            std::to_string(kLargestPicture);
    return false;
}

std::string picturePath(const std::string& directory, std::int64_t step) { return directory + '/' + pictureName(step); }

std::vector<std::int64_t> sheetSteps(StepSpan span, int count) {
    std::vector<std::int64_t> chosen;
    for (int i = 0; i < count; ++i) {
        const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 1.0;
        const auto length = static_cast<double>(span.last - span.first);
        const auto step = span.first + static_cast<std::int64_t>(std::llround(share * length));
        if (chosen.empty() || step > chosen.back()) { chosen.push_back(step); }
    }
    return chosen;
}

void addPicturePlaces(OutputFiles& outputs, const PictureArguments& arguments, StepSpan span) {
    const auto isPicture = [=](const std::string& name) {
        if (name == kSheetName) { return arguments.sheet > 0; }
        const std::optional<std::int64_t> step = stepOfPicture(name);
        return step && span.includes(*step, arguments.every.value_or(1));
    };
    outputs.addDirectory("--png", arguments.directory, isPicture);
    outputs.addFile("--webp", arguments.webp);
}

void printPicturePlaces(std::ostream& out, const PictureArguments& arguments, StepSpan span) {
    if (!arguments.directory.empty()) {
        const std::int64_t older = olderPictures(arguments, span);
        out << "pictures  " << arguments.directory << "/frame_*.png"
            << (older > 0 ? " (and " + countText(older, "picture") + " of an earlier run)" : "") << '\n';
    }
    if (arguments.sheet > 0) { out << "sheet     " << sheetPath(arguments) << '\n'; }
    if (!arguments.webp.empty()) { out << "animation " << arguments.webp << '\n'; }
}

std::unique_ptr<PictureOutput> makePictureOutput(const SceneDescription& scene, const PictureArguments& arguments,
                                                 const Camera& camera, StepSpan span, std::string& error) {
    PictureSize size;
    // First: that a value makes no sense is worth more than that the option does not either.
    if (!parseSize(arguments.size.empty() ? kDefaultSize : arguments.size, size, error)) { return nullptr; }
    error = faultOf(arguments, static_cast<double>(span.last - span.first) * scene.settings.dt);
    if (!error.empty()) { return nullptr; }
    if (arguments.directory.empty() && arguments.webp.empty()) { return nullptr; }
    warnOfSlowMotion(arguments, span, scene.settings.dt);
    auto pictures = std::make_unique<Pictures>(arguments, span, scene.settings.dt);
    if (pictures->create(scene, camera, size, error)) { return pictures; }
    error = "no pictures: " + error;
    return nullptr;
}

}  // namespace swept
