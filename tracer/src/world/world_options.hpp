// Options for preparing a scene's objects; see CellOptions for those that are not documented here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "phasetree/cells/cells.hpp"
#include "shading/shared_surfaces.hpp"

namespace phasetree::tracer {

struct WorldOptions {
    BuildQuality quality = BuildQuality::medium;
    /// Whether the world is for a quick preview with few rays. It has few large cells, whatever the quality, and the
    /// object's flat sides are not determined (flat_boundaries.hpp). Pictures are the same except for more noise.
    bool is_first_look = false;
    std::function<bool()> cancelled{};
    std::function<void(float)> progress{};
    std::size_t max_bytes = 0;
    /// Cells that may be those of the scene's one tree. If they are, they are not rebuilt.
    std::shared_ptr<const InterfaceCells> known_cells{};
    /// A cache of surfaces, which this scene extends.
    std::shared_ptr<SharedSurfaces> surfaces{};
    /// The configuration of Embree's device (rtcNewDevice), such as "isa=sse2"; Embree's defaults if empty.
    std::string embree_configuration{};
    std::optional<std::filesystem::path> kept_cells{};  ///< cache file for the object's cells: see kept_cells.hpp
};

}  // namespace phasetree::tracer
