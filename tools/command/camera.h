#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <swept/samples/render/render_options.h>
#include <swept/samples/scene_description.h>

#include "options.h"

namespace swept {

/// Where the pictures of a command look, as typed.
struct CameraArguments {
    std::string view;    ///< "X,Y,HEIGHT"; empty: the scene's own view, or one fitted to its bodies
    std::string follow;  ///< name of a body; empty: the view does not move
};

/// The same, understood.
struct Camera {
    std::optional<ViewDescription> view;  ///< its centre counts from the body, where one is followed
    std::optional<std::size_t> follow;    ///< index of the body

    bool isGiven() const { return view || follow; }
    void applyTo(RenderOptions& options) const;
};

void addCameraArguments(Command command, CameraArguments& arguments);

/// @return nothing, and one line in `error`, when the view makes no sense or the scene has no body of that name.
std::optional<Camera> cameraOf(const CameraArguments& arguments, const SceneDescription& scene, std::string& error);

/// What is wrong with options for a picture that is not asked for, where `--png` would: "--view needs --png". Empty:
/// none is given.
std::string faultWithoutPicture(const std::string& size, const CameraArguments& camera);

}  // namespace swept
