// A scene's file as a live view reads and writes it.
#pragma once

#include <optional>
#include <string>

#include "command/scene_file.hpp"
#include "view/viewed_scene.hpp"

namespace phasetree::tracer {

struct ViewedFile {
    SceneFile scene;
    std::optional<std::string> display, view;  // of OpenColorIO, instead of the scene's

    // What a session reads the scene by. Reads it a first time at once, so that what is wrong from the start is thrown
    // here: SceneError, DisplayError.
    view::ReadScene reader() const;
    // Put into the file what is wished, and keep who may read and write it. Throw SceneError and OutputError.
    void write_camera(const std::string& camera) const;
    void write_numbers(const view::NumberEdits&) const;
};

}  // namespace phasetree::tracer
