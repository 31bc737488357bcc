#pragma once

#include <memory>
#include <string>

#include "phasetree/building/options.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/ray.hpp"

namespace phasetree {

namespace cells {
struct CellsFile;
}

/// An object divided into cells: boxes around its interfaces, each with the few instructions that matter there. A ray
/// meets a change of phase only inside a cell. The caller finds the cells along a ray, with Embree for instance.
///
/// A cell's program gives the labels of the whole object within the cell and up to reach() beyond it, and distances
/// within which the label stays the same there. Cells are immutable; any thread may read them.
class InterfaceCells {
  public:
    /// Builds the cells, with all threads that TBB gives it. Throws ModelError if the object is unbounded, empty, too
    /// large, or too far from the origin for its size, and BuildCancelled if CellOptions::cancelled has ended the
    /// build.
    explicit InterfaceCells(const Phased& object, const CellOptions& options = {});
    ~InterfaceCells();

    /// The number of cells.
    std::size_t size() const;
    /// A cell's box, which reaches beyond its share of space by reach(), so that no ray passes between two cells.
    Bounds bounds(std::size_t cell) const;
    /// The box of the whole object, with a margin of vacuum.
    const Bounds& bounds() const;

    /// The first change of phase along a ray within one cell: as InterfaceTracer::first_crossing. The hint must be that
    /// of this cell.
    std::optional<Crossing> first_crossing(std::size_t cell, const TracedRay&, float t_min, float t_max,
                                           std::optional<Phase> carried, const std::optional<LeavingHint>&,
                                           TraceCounters&) const;
    /// The same for a ray that is used for one cell only, without a hint.
    std::optional<Crossing> first_crossing(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction,
                                           float t_min, float t_max, std::optional<Phase> carried,
                                           Evaluator::Workspace&, TraceCounters&) const;
    /// The normal of a crossing that was found in this cell.
    CrossingNormal normal(std::size_t cell, const Crossing&, const glm::vec3& direction) const;

    /// The phases and interface distances at points origin + t·direction, which must be in the cell, by its program.
    void sample_ray(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t,
                    Samples&, Evaluator::Workspace&) const;

    /// The phase at a point, by the program of the whole object; the vacuum outside of bounds().
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;
    /// The phase at a point of the cell, by its program.
    Phase label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace&) const;

    /// The program of the whole object.
    const Evaluator& whole() const;
    /// The resolution that is used, in the scene's unit of length.
    float resolution() const;
    /// A sentence for people, mostly empty: see TraceableObject.
    const std::string& warning() const;
    /// How far a cell's box reaches beyond its share of space, in the scene's unit of length: a few resolutions.
    float reach() const;
    /// CellOptions::opaque.
    PhaseSet opaque() const;
    CellStatistics statistics() const;

  private:
    friend struct cells::CellsFile;
    struct Data;
    explicit InterfaceCells(std::unique_ptr<const Data>);
    std::unique_ptr<const Data> data_;
};

}  // namespace phasetree
