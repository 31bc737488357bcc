#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/ray.hpp"

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

/// An object cut into boxes around its interfaces, each with the few instructions that matter there. A ray meets a
/// change of phase only inside a cell; in which order cells are tried is the caller's business (Embree's, for one).
///
/// A cell's program gives the whole object's labels within the cell and a hair beyond (reach()), and distances that are
/// valid there. Immutable; any thread may read it.
class InterfaceCells {
  public:
    /// Throws ModelError if the object is unbounded, empty, too large, or too far from the origin for its size.
    explicit InterfaceCells(const Phased& object, const CellOptions& options = {});
    ~InterfaceCells();

    std::size_t size() const;
    /// A cell's box, a hair larger than its share of space so that rays cannot slip between two.
    Bounds bounds(std::size_t cell) const;
    /// The box of the whole object, with a margin of vacuum.
    const Bounds& bounds() const;

    /// As InterfaceTracer::first_crossing, within one cell.
    std::optional<Crossing> first_crossing(std::size_t cell, const TracedRay&, float t_min, float t_max,
                                           std::optional<Phase> carried, const std::optional<LeavingHint>&,
                                           TraceCounters&) const;
    std::optional<Crossing> first_crossing(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction,
                                           float t_min, float t_max, std::optional<Phase> carried,
                                           Evaluator::Workspace&, TraceCounters&) const;
    /// The normal of a crossing found in the cell.
    CrossingNormal normal(std::size_t cell, const Crossing&, const glm::vec3& direction) const;

    /// Phase and interface distance along a ray by the cell's program, at origin + t·direction; all within the cell.
    void sample_ray(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t,
                    Samples&, Evaluator::Workspace&) const;

    /// The phase at a point, by the whole object's program; vacuum outside the bounds.
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;
    /// The phase at a point by the cell's program; p within the cell.
    Phase label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace&) const;

    const Evaluator& whole() const;
    float resolution() const;
    /// For people: that coordinates leave few digits, or that the resolution is not the one that was asked for. Mostly
    /// empty.
    const std::string& warning() const;
    /// How far a cell's box reaches beyond its share of space.
    float reach() const;
    PhaseSet opaque() const;
    CellStatistics statistics() const;

  private:
    friend struct CellsFile;  // cells/file.hpp
    struct Data;
    explicit InterfaceCells(std::unique_ptr<const Data>);
    std::unique_ptr<const Data> data_;
};

}  // namespace phasetree
