// How the object of a scene is prepared for rays; what is not said here is as CellOptions has it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

struct WorldOptions {
    BuildQuality quality = BuildQuality::medium;
    std::function<bool()> cancelled{};
    std::function<void(float)> progress{};
    std::size_t most_bytes = 0;
    /// Cells that may be those of the scene's one tree. If they are, they are not built again.
    std::shared_ptr<const InterfaceCells> known_cells{};
    std::optional<std::filesystem::path> kept_cells{};  ///< a file for the object's cells: see kept_cells.hpp
};

}  // namespace phasetree::tracer
