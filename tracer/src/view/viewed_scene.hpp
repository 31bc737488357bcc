// The scene that is viewed, as whoever starts the view reads it.
#pragma once

#include <functional>
#include <string>

#include "output/display.hpp"
#include "scene/scene.hpp"
#include "view/watched_files.hpp"

namespace phasetree::tracer::view {

struct ViewedScene {
    Scene scene;
    /// How the scene is shown, but for the exposure.
    std::function<DisplayTransform(float exposure_ev)> display;
};

/// Reads the scene, and names each file before it reads it. Throws what reading a scene throws; the files that were
/// named until then are watched all the same.
using ReadScene = std::function<ViewedScene(WatchedFiles&)>;

}  // namespace phasetree::tracer::view
