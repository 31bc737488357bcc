// How the object of a scene is prepared for rays; what is not said here is as CellOptions has it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "phasetree/cells/cells.hpp"
#include "shading/shared_surfaces.hpp"

namespace phasetree::tracer {

struct WorldOptions {
    BuildQuality quality = BuildQuality::medium;
    /// Whether the world is for a first look, of few rays, which does not wait: it has few large cells, whatever the
    /// quality, and the flat sides of the object are not looked for (flat_boundaries.hpp). Its pictures show the same,
    /// with more noise.
    bool is_first_look = false;
    std::function<bool()> cancelled{};
    std::function<void(float)> progress{};
    std::size_t most_bytes = 0;
    /// Cells that may be those of the scene's one tree. If they are, they are not built again.
    std::shared_ptr<const InterfaceCells> known_cells{};
    /// Surfaces that were made before, which those of this scene are added to.
    std::shared_ptr<SharedSurfaces> surfaces{};
    std::optional<std::filesystem::path> kept_cells{};  ///< a file for the object's cells: see kept_cells.hpp
};

}  // namespace phasetree::tracer
