#pragma once

#include <memory>
#include <string>

#include "phasetree/building/options.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/ray.hpp"

namespace phasetree {

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
