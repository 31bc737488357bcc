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

/// How much is built before rays are traced. What they find is the same.
enum class BuildQuality {
    low,    ///< for objects that are built anew all the time: a quarter to two thirds of the time, slower rays
    medium  ///< for most
};

struct CellOptions {
    float resolution = 0;  ///< see InterfaceTracer
    int deepest = 14;      ///< divisions from the bounds to the smallest cell
    BuildQuality quality = BuildQuality::medium;
    /// Phases that no ray is ever in, because they are opaque to it. Where two of them meet nothing is looked for, and
    /// no cells are made for it; what is found for a ray that is in one all the same means nothing.
    PhaseSet opaque{};
    std::function<bool()> cancelled{};  ///< asked now and then, by any thread; true ends the build
    /// Told now and then how much is done, in (0, 1]: by any of the threads that build, but by one at a time, and each
    /// time more than before; 1 is the last. The building waits for it.
    std::function<void(float)> progress{};
    /// About how many bytes of memory the cells may take while they are built and later, Embree's tree over them
    /// included; 0 for default_cell_bytes(). If they would take more, boxes below some size are not divided: rays find
    /// the same, more slowly. One cell there is, whatever it takes. The cells do not depend on the number of threads.
    std::size_t most_bytes = 0;
};

/// Two gigabytes, or a quarter of the memory that the machine has or that this process may use, if that is less.
std::size_t default_cell_bytes();

struct CellStatistics {
    std::size_t cells = 0;
    std::size_t routines = 0;  ///< different programs among the cells
    std::size_t bytes = 0;     ///< cells, routines and the constants they share
    std::size_t median_instructions = 0, percentile90_instructions = 0, most_instructions = 0;
    double build_seconds = 0;
    bool is_coarser = false;  ///< CellOptions::most_bytes left boxes undivided
};

}  // namespace phasetree
