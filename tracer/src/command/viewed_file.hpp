// The scene file of a live view: reading and writing.
#pragma once

#include <optional>
#include <string>

#include "command/scene_file.hpp"
#include "view/viewed_scene.hpp"

namespace phasetree::tracer {

struct ViewedFile {
    SceneFile scene;
    std::optional<std::string> display, view;  // OpenColorIO names that override the scene's

    // A function that reads the scene for a session. Reads it once immediately, so that an initially invalid scene
    // throws here: SceneError, DisplayError.
    view::ReadScene reader() const;
    // Write the change to the file and keep its permissions. Throw SceneError and OutputError.
    void write_camera(const std::string& camera) const;
    void write_numbers(const view::NumberEdits&) const;
};

}  // namespace phasetree::tracer
