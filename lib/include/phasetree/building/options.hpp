#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

#include "phasetree/model/phase.hpp"

namespace phasetree {

/// Thrown by a build that CellOptions::cancelled has stopped.
class BuildCancelled : public std::runtime_error {
  public:
    BuildCancelled() : std::runtime_error("the building of cells was cancelled") {}
};

/// How long cells are built before rays are traced. What rays find does not depend on it.
enum class BuildQuality {
    low,    ///< for objects that are built again and again: a quarter to two thirds of the time, slower rays
    medium  ///< for most objects
};

/// How cells are built.
struct CellOptions {
    float resolution = 0;  ///< in the scene's unit of length; 0 chooses one: see InterfaceTracer
    /// The most divisions from the bounds to the smallest cell; a box in which meshes or listed balls would have to be
    /// searched at each sample may be divided three times more, unless this is less than the default.
    int deepest = 14;
    BuildQuality quality = BuildQuality::medium;
    /// Phases that rays never enter, because they are opaque. Interfaces between two of them are not searched for and
    /// have no cells. Results for a ray inside one of these phases are meaningless.
    PhaseSet opaque{};
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to cancel the build
    /// Receives the fraction of the build that is done, in (0, 1], strictly increasing up to 1. Called from any
    /// building thread, one at a time; the build waits for it.
    std::function<void(float)> progress{};
    /// About how many bytes the cells may take while they are built and later, Embree's tree over them included; 0 for
    /// default_cell_bytes(). If they would take more, boxes whose division saves little are not divided, and rays find
    /// the same more slowly. The memory for a single cell is always granted. The cells do not depend on the number of
    /// threads.
    std::size_t most_bytes = 0;
};

/// The default of CellOptions::most_bytes: two gigabytes, or a quarter of the memory that the machine has or that this
/// process may use, if that is less.
std::size_t default_cell_bytes();

/// What was built.
struct CellStatistics {
    std::size_t cells = 0;
    std::size_t routines = 0;  ///< different programs among those of the cells
    std::size_t bytes = 0;     ///< cells, routines and the constants they share
    std::size_t median_instructions = 0, percentile90_instructions = 0, most_instructions = 0;
    double build_seconds = 0;
    bool is_coarser = false;  ///< whether boxes were left undivided because of CellOptions::most_bytes
};

}  // namespace phasetree
