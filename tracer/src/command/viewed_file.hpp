// The scene file of a live view: reading and writing.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "command/scene_file.hpp"
#include "studio/edited_document.hpp"
#include "view/viewed_scene.hpp"

namespace phasetree::tracer {

// Reads the scene both for the session and to check steps before they are made.
class SceneReadings;

struct ViewedFile {
    SceneFile scene;
    std::optional<std::string> display, view;  // OpenColorIO names that override the scene's
    std::shared_ptr<SceneReadings> readings = new_readings();

    // The text of the file, for editing. `saves` is whether each change is saved at once. Throws SceneError.
    std::unique_ptr<studio::EditedDocument> document(bool saves) const;
    // A function that reads the scene for a session from an edited document, which must outlive it. Reads it once
    // immediately, so that wrong options throw here: DisplayError. An invalid scene is reported by the session.
    view::ReadScene reader(studio::EditedDocument& document) const;

  private:
    std::shared_ptr<SceneReadings> new_readings() const;
};

// Write the change into the document and its file, as a step that can be undone. Throw SceneError and OutputError.
void write_camera(studio::EditedDocument&, const std::string& camera);
void write_numbers(studio::EditedDocument&, const view::NumberEdits&);

}  // namespace phasetree::tracer
