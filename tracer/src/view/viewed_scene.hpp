// The scene that is viewed, as whoever starts the view reads it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "output/display.hpp"
#include "phasetree/io/node_places.hpp"
#include "scene/scene.hpp"
#include "view/numbers.hpp"
#include "view/watched_files.hpp"

namespace phasetree::tracer::view {

/// From a time to a later one, in seconds.
struct TimeSpan {
    double first = 0, last = 0;
};

/// What is wished to stand instead of what the file and the command say.
struct Reading {
    NumberEdits numbers{};
    std::optional<double> seconds{};  ///< the time at which it is read
};

struct ViewedScene {
    Scene scene;
    /// How the scene is shown, but for the exposure.
    std::function<DisplayTransform(float exposure_ev)> display;
    std::optional<Document> file{};  ///< of the scene, without the numbers that stand instead of its own:
    NumberEdits edits{};
    TextNumbers numbers{};           ///< of the file
    NodePlaces places{};             ///< of the object's nodes, with those numbers
    std::string warnings{};          ///< of the reader, each with a newline behind it
    double seconds = 0;              ///< the time at which it was read,
    std::optional<TimeSpan> keys{};  ///< and from the first key to the last; nothing where nothing changes with time

    /// Where a node stands in its file, as that is; nothing for one that stands in none.
    std::optional<NodePlace> place_of(const void* node) const;
};

/// Reads the scene as it is wished, and names each file before it reads it. Throws what reading a scene throws; the
/// files that were named until then are watched all the same.
using ReadScene = std::function<ViewedScene(WatchedFiles&, const Reading&)>;

}  // namespace phasetree::tracer::view
