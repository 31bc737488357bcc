// The scene being viewed, and how it is read.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/display.hpp"
#include "phasetree/io/node_places.hpp"
#include "scene/scene.hpp"
#include "studio/watched_files.hpp"
#include "view/numbers.hpp"

namespace phasetree::tracer::view {

using studio::WatchedFiles;

/// A range of times, in seconds.
struct TimeSpan {
    double first = 0, last = 0;
};

/// Parts of the scene that are left out (studio/hidden_parts.hpp).
struct HiddenParts {
    std::vector<std::string> pointers{};
    std::shared_ptr<const std::string> text{};  ///< that the pointers refer to; null: the current one
    bool operator==(const HiddenParts&) const = default;
};

/// Values that override those of the file and the command line.
struct Reading {
    NumberEdits numbers{};
    std::optional<double> seconds{};  ///< the time at which the scene is read
    HiddenParts hidden{};
};

struct ViewedScene {
    Scene scene;
    /// How the scene is displayed, except for the exposure.
    std::function<DisplayTransform(float exposure_ev)> display;
    std::optional<Document> file{};  ///< the scene's file, without the edits
    NumberEdits edits{};             ///< the numbers replaced when the scene was read
    TextNumbers numbers{};           ///< of the file
    NodePlaces places{};             ///< of the object's nodes, with the overridden numbers
    std::string warnings{};          ///< from the reader, each with a newline at the end
    double seconds = 0;              ///< the time of the animation at which it was read
    std::optional<TimeSpan> keys{};  ///< the range of its keys; empty if nothing changes with time
    HiddenParts hidden{};            ///< those of the request, in the text that was read

    /// The position of a node in the unmodified file; nullopt for a node that is not in a file.
    std::optional<NodePlace> place_of(const void* node) const;
};

/// Reads the scene as requested. Adds each file before reading it, so that files added before an exception are watched
/// too. Throws what reading a scene throws.
using ReadScene = std::function<ViewedScene(WatchedFiles&, const Reading&)>;

}  // namespace phasetree::tracer::view
