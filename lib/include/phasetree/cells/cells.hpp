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
/// changes phase only inside a cell. The caller finds the cells along a ray, for example with Embree.
///
/// Everywhere in bounds(cell), the cell's program returns the same labels (phases) as the program of the whole object,
/// and a distance within which the label does not change. Immutable; any thread may read it.
class InterfaceCells {
  public:
    /// Build the cells, with all threads of TBB's arena. Throws ModelError if the object is unbounded, empty, too small
    /// or too large for floats, or too far from the origin for its size, and BuildCancelled if CellOptions::cancelled
    /// returned true.
    explicit InterfaceCells(const Phased& object, const CellOptions& options = {});
    ~InterfaceCells();

    /// The number of cells.
    std::size_t size() const;
    /// A cell's box: the cell's share of space, enlarged by reach() on each side so that no ray passes between two
    /// cells. Shares do not overlap.
    Bounds bounds(std::size_t cell) const;
    /// The box of the whole object, with a margin of vacuum.
    const Bounds& bounds() const;

    /// Find the first change of phase along a ray within one cell, like InterfaceTracer::first_crossing(). For a ray
    /// that starts at a crossing found in this cell, a hint made from that crossing usually makes the search
    /// unnecessary. A hint from another cell's crossing must not be passed.
    std::optional<Crossing> first_crossing(std::size_t cell, const TracedRay&, float t_min, float t_max,
                                           std::optional<Phase> carried, const std::optional<LeavingHint>&,
                                           TraceCounters&) const;
    /// The same without a hint, for a ray that is used for one cell only.
    std::optional<Crossing> first_crossing(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction,
                                           float t_min, float t_max, std::optional<Phase> carried,
                                           Evaluator::Workspace&, TraceCounters&) const;
    /// The normal of a crossing found in this cell.
    CrossingNormal normal(std::size_t cell, const Crossing&, const glm::vec3& direction) const;

    /// Evaluate the cell's program at points origin + t·direction, which must be in the cell.
    void sample_ray(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t,
                    Samples&, Evaluator::Workspace&) const;

    /// The phase at a point, from the program of the whole object; the vacuum outside bounds().
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;
    /// The phase at a point in the cell, from the cell's program.
    Phase label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace&) const;

    /// The program of the whole object.
    const Evaluator& whole() const;
    /// The resolution in use, in the scene's unit of length.
    float resolution() const;
    /// A message for the user, usually empty; see TraceableObject.
    const std::string& warning() const;
    /// How far a cell's box extends beyond its share of space, in the scene's unit of length: a few resolutions.
    float reach() const;
    /// The farthest that a cell's crossing may lie before the point where the ray enters the cell's box, in the scene's
    /// unit of length. If the phase has already changed at that point, the search looks back this far for the change.
    float look_back() const;
    /// The phases of CellOptions::opaque.
    PhaseSet opaque() const;
    CellStatistics statistics() const;

  private:
    friend struct cells::CellsFile;
    struct Data;
    explicit InterfaceCells(std::unique_ptr<const Data>);
    std::unique_ptr<const Data> data_;
};

}  // namespace phasetree
