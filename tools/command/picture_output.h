#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

#include "../writers/output_files.h"
#include "camera.h"
#include "options.h"

namespace swept {

/// What `swept run` can draw.
struct PictureArguments {
    std::string directory;  ///< for PNGs and the contact sheet
    std::string webp;
    std::optional<std::int64_t> every;  ///< steps between pictures; 1 where none is given
    std::string size;                   ///< kDefaultSize where none is given
    int sheet = 0;                      ///< moments on the contact sheet; 0: none
    CameraArguments camera;
    bool trails = false;
    bool contacts = false;
    bool velocities = false;
    bool ghosts = false;
    bool sweeps = false;
    bool labels = false;
};

/// The steps of a run that are told of: from the state after `first` steps to that after `last`.
struct StepSpan {
    std::int64_t first = 0;
    std::int64_t last = 0;

    /// Whether the state after `step` steps is one of every so many, counted from the first.
    bool includes(std::int64_t step, std::int64_t every = 1) const {
        return step >= first && step <= last && (step - first) % every == 0;
    }
};

/// Width and height in pixels.
struct PictureSize {
    int width = 0;
    int height = 0;
};

void addPictureArguments(Command command, PictureArguments& arguments);

/// What is wrong with the name of a picture of this format ("PNG"): it ends as those of another one do. A name without
/// an ending is none. Empty: nothing is wrong.
std::string endingFault(const std::string& flag, const std::string& path, const std::string& format);

/// "1280x720" as numbers. @return false, and one line in `error`, when it is none or out of range.
bool parseSize(const std::string& text, PictureSize& size, std::string& error);

/// The path of the picture after `step` steps: DIR/frame_000120.png.
std::string picturePath(const std::string& directory, std::int64_t step);

/// Steps shown on a contact sheet of `count` moments: equally spaced, the first and the last of the span among them.
std::vector<std::int64_t> sheetSteps(StepSpan span, int count);

/// @param span  earlier and later pictures are not written
void addPicturePlaces(OutputFiles& outputs, const PictureArguments& arguments, StepSpan span);
/// @param span  as far as it was run. Pictures of an earlier run that this one did not draw over are told.
void printPicturePlaces(std::ostream& out, const PictureArguments& arguments, StepSpan span);

/// Draws the states it is shown, where and as often as the arguments say.
class PictureOutput {
public:
    virtual ~PictureOutput() = default;
    /// Whether frames should carry contacts and impacts.
    virtual bool wantsContacts() const = 0;
    /// To be called with every step's state and events, from step 0 on (before its span they need no contacts); draws
    /// the ones asked for.
    /// @return false, and one line in `error`, when a picture could not be written.
    virtual bool show(const Frame& frame, std::span<const SceneEvent> events, std::string& error) = 0;
    /// Writes what needs the whole run: the animation, the contact sheet.
    virtual bool finish(std::string& error) = 0;
};

/// @param camera  as the arguments have it for this scene.
/// @param span    what is drawn of the run.
/// @return null without error when no picture is asked for; null and one line in `error` when the arguments make no
/// sense or
///         the renderer cannot be set up.
std::unique_ptr<PictureOutput> makePictureOutput(const SceneDescription& scene, const PictureArguments& arguments,
                                                 const Camera& camera, StepSpan span, std::string& error);

}  // namespace swept
