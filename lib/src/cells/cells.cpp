// Queries of InterfaceCells, except the search along a ray (search.cpp).
#include "phasetree/cells/cells.hpp"

#include <algorithm>

#include "cells/data.hpp"
#include "evaluation/batch_of_points.hpp"
#include "evaluation/target.hpp"
#include "trace/normal.hpp"

namespace phasetree {

using evaluation::active_kernel, evaluation::BatchOfPoints, evaluation::component;
using kernel::PackedCertificateStep;
using trace::NormalOf;

std::size_t InterfaceCells::size() const {
    return data_->cells.size();
}
Bounds InterfaceCells::bounds(std::size_t cell) const {
    return data_->cells[cell].box;
}
const Bounds& InterfaceCells::bounds() const {
    return data_->bounds;
}

CrossingNormal InterfaceCells::normal(std::size_t cell, const Crossing& crossing, const glm::vec3& direction) const {
    const Data::Cell& c = data_->cells[cell];
    if (const auto faces = data_->faces_of(cell); !faces.empty()) {
        const auto normal =
            trace::normal_of_face(data_->faces_of_cell(c, faces), crossing, direction, data_->resolution);
        if (normal) return {*normal, *normal};
    }
    const auto component_at = [&](const glm::vec3& p, Phase phase) {
        return component(data_->routine(c), data_->slots(c), p, phase);
    };
    const auto holds = [&](const glm::vec3& p) { return c.box.contains(p); };
    return NormalOf(crossing, direction, data_->resolution, component_at, holds)();
}

void InterfaceCells::sample_ray(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction,
                                const BatchOfFloats& t, Samples& out, Evaluator::Workspace& w) const {
    const Data::Cell& c = data_->cells[cell];
    active_kernel().sample_ray(data_->routine(c), &origin.x, &direction.x, t.lane.data(), w.registers(data_->slots(c)),
                               out.label.lane.data(), out.distance.lane.data());
}

Phase InterfaceCells::label(const glm::vec3& p, Evaluator::Workspace& w) const {
    return data_->bounds.contains(p) ? data_->whole->label(p, w) : vacuum;
}

Phase InterfaceCells::label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace& w) const {
    const auto [x, y, z] = BatchOfPoints::all_at(p);
    Samples s;
    const Data::Cell& c = data_->cells[cell];
    active_kernel().sample(data_->routine(c), x.lane.data(), y.lane.data(), z.lane.data(), w.registers(data_->slots(c)),
                           s.label.lane.data(), s.distance.lane.data());
    return Phase{static_cast<std::uint8_t>(s.label[0])};
}

const Evaluator& InterfaceCells::whole() const {
    return *data_->whole;
}
float InterfaceCells::resolution() const {
    return data_->resolution;
}
const std::string& InterfaceCells::warning() const {
    return data_->warning;
}
float InterfaceCells::reach() const {
    return data_->reach;
}
float InterfaceCells::look_back() const {
    return kernel::look_back_resolutions * data_->resolution;
}

PhaseSet InterfaceCells::opaque() const {
    return data_->opaque;
}

CellStatistics InterfaceCells::statistics() const {
    CellStatistics s;
    s.cells = data_->cells.size();
    s.routines = data_->routine_count;
    s.bytes = data_->cells.size() * sizeof(Data::Cell) + data_->routines.bytes() +
              data_->certificates.size() * sizeof(PackedCertificateStep) +
              data_->first_certificate.size() * sizeof(data_->first_certificate[0]) +
              data_->faces.size() * sizeof(data_->faces[0]) +
              data_->first_faces.size() * sizeof(data_->first_faces[0]) + data_->whole->bytes();
    s.build_seconds = data_->build_seconds;
    s.is_coarser = data_->is_coarser;
    if (data_->cells.empty()) return s;
    std::vector<std::size_t> length;
    for (std::size_t i = 0; i < size(); ++i) length.push_back(data_->routines.shapes[data_->cells[i].shape].steps);
    std::sort(length.begin(), length.end());
    s.median_instructions = length[length.size() / 2];
    s.percentile90_instructions = length[length.size() * 9 / 10];
    s.max_instructions = length.back();
    return s;
}

}  // namespace phasetree
