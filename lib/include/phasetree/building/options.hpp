#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

#include "phasetree/model/phase.hpp"

namespace phasetree {

/// Thrown by a build that CellOptions::cancelled has stopped.
class BuildCancelled : public std::runtime_error {
  public:
    BuildCancelled() : std::runtime_error("building cells was cancelled") {}
};

/// The trade-off between the time to build cells and the time to trace rays. Crossings are the same for both.
enum class BuildQuality {
    low,    ///< for objects that are rebuilt often: builds in 25 to 75 % of the time of medium; rays are slower
    medium  ///< for most objects
};

/// Options for building cells.
struct CellOptions {
    float resolution = 0;  ///< in the scene's unit of length; 0 for a default; see InterfaceTracer
    /// The maximum number of divisions from the bounds to the smallest cell. At the default or above, the limit is
    /// three levels higher for boxes in which every sample has to search a `mesh` or `balls` node.
    int max_depth = 14;
    BuildQuality quality = BuildQuality::medium;
    /// Phases that rays never enter because they are opaque. Interfaces between two of them are not searched for and
    /// have no cells. Results for a ray inside one of these phases are meaningless.
    PhaseSet opaque{};
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to cancel the build
    /// Receives the fraction of the build that is done, in (0, 1], strictly increasing up to 1. Called from any
    /// building thread, one at a time, while the build waits.
    std::function<void(float)> progress{};
    /// Approximate memory limit in bytes, during and after the build, for the cells and Embree's BVH over them; 0 for
    /// default_cell_bytes(). To stay below it, boxes whose division saves little are left undivided. Rays then find the
    /// same crossings more slowly. The memory for a single cell is always granted. The cells do not depend on the
    /// number of threads.
    std::size_t max_bytes = 0;
};

/// The default of CellOptions::max_bytes: the smaller of 2 GiB and a quarter of the memory of the machine, or of what
/// is available to this process if that is limited.
std::size_t default_cell_bytes();

/// Statistics of a build.
struct CellStatistics {
    std::size_t cells = 0;
    std::size_t routines = 0;  ///< distinct programs of the cells
    std::size_t bytes = 0;     ///< of cells, routines and their shared constants
    std::size_t median_instructions = 0, percentile90_instructions = 0, max_instructions = 0;
    double build_seconds = 0;
    bool is_coarser = false;  ///< whether CellOptions::max_bytes left boxes undivided
};

}  // namespace phasetree
