// Phases and distances at points. A single point is handled like many: eight are evaluated together.

#include "api/points.hpp"

#include <limits>

#include "embree_core/closest.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

using Batch = std::array<BatchOfFloats, 3>;

// Φ at each point of a batch.
std::array<Phases<float>, batch_size> distances(const Evaluator& whole, const Batch& batch,
                                                std::vector<BatchOfFloats>& room) {
    const auto& outputs = whole.program().outputs;
    room.resize(outputs.size());
    whole.evaluate(batch[0], batch[1], batch[2], room, Evaluator::thread_workspace());
    std::array<Phases<float>, batch_size> all;
    for (std::size_t i = 0; i < batch_size; ++i)
        for (std::size_t k = 0; k < outputs.size(); ++k) all[i].set(outputs[k].phase.index, room[k][i]);
    return all;
}

// The radius of a ball in geometry space that contains no interface. Its centre is a point of the tree's space with a
// known sampled distance to an interface.
float radius_without_interface(const GeometryData& data, const glm::vec3& p, float sampled,
                               const Placement& placement) {
    const InterfaceCells& cells = data.object->cells();
    const float radius =
        cells.bounds().contains(p) ? sampled : glm::distance(p, glm::clamp(p, cells.bounds().low, cells.bounds().high));
    const float safe = std::max(0.0f, radius - cells.resolution());
    return data.motion.none() ? safe
                              : static_cast<float>(static_cast<double>(safe) / largest_stretch(placement.inverse));
}

// The radii may be NULL.
void write_phases(const GeometryData& data, const Points& points, unsigned* phases, float* empty_radii) {
    const InterfaceCells& cells = data.object->cells();
    const FlushSubnormals flush;
    std::vector<BatchOfFloats> room;
    points.each_batch([&](std::size_t first, std::size_t count, const Batch& batch) {
        const auto point = [&](std::size_t i) { return glm::vec3(batch[0][i], batch[1][i], batch[2][i]); };
        bool is_any_within = false;  // otherwise all are in the vacuum, and nothing is evaluated
        for (std::size_t i = 0; i < count; ++i) is_any_within |= cells.bounds().contains(point(i));
        std::array<Phases<float>, batch_size> phi;
        if (is_any_within) phi = distances(cells.whole(), batch, room);
        Samples s;
        if (empty_radii) cells.whole().sample(batch[0], batch[1], batch[2], s, Evaluator::thread_workspace());
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 p = point(i);
            phases[first + i] = cells.bounds().contains(p) ? label(phi[i]).index : vacuum.index;
            if (empty_radii)
                empty_radii[first + i] = radius_without_interface(data, p, s.distance[i], points.placement(first + i));
        }
    });
}

void write_distances(const GeometryData& data, const Points& points, unsigned phase_count, float* out,
                     std::size_t point_stride, std::size_t phase_stride) {
    const FlushSubnormals flush;
    std::vector<BatchOfFloats> room;
    points.each_batch([&](std::size_t first, std::size_t count, const Batch& batch) {
        const auto phi = distances(data.object->cells().whole(), batch, room);
        for (std::size_t i = 0; i < count; ++i) {
            for (unsigned k = 0; k < phase_count; ++k) {
                const int phase = static_cast<int>(k);
                const float d = phi[i].has(phase) ? phi[i][phase] : std::numeric_limits<float>::infinity();
                std::memcpy(reinterpret_cast<std::byte*>(out) + point_stride * (first + i) + phase_stride * k, &d,
                            sizeof d);
            }
        }
    });
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeGetPhase(PhasetreeGeometry geometry, const float* point, float time, unsigned int* phase,
                                 float* empty_radius) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points one(data, point, time);
        require(phase, "phase");
        write_phases(data, one, phase, empty_radius);
    });
}

PhasetreeError phasetreeGetDistances(PhasetreeGeometry geometry, const float* point, float time, float* distances) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points one(data, point, time);
        require(distances, "distances");
        write_distances(data, one, PHASETREE_MAX_PHASES, distances, PHASETREE_MAX_PHASES * sizeof(float),
                        sizeof(float));
    });
}

PhasetreeError phasetreeGetTreePoint(PhasetreeGeometry geometry, const float* point, float time, float* tree_point) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points one(data, point, time);
        require(tree_point, "treePoint");
        write_point(tree_point, one[0]);
    });
}

PhasetreeError phasetreeGetPhaseN(PhasetreeGeometry geometry, const PhasetreePoints* points, unsigned int* phases,
                                  float* empty_radii) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points all(data, points);
        if (all.size() > 0) require(phases, "phases");
        write_phases(data, all, phases, empty_radii);
    });
}

PhasetreeError phasetreeGetDistancesN(PhasetreeGeometry geometry, const PhasetreePoints* points,
                                      unsigned int phase_count, float* out, size_t point_stride, size_t phase_stride) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points all(data, points);
        if (phase_count < 1 || phase_count > PHASETREE_MAX_PHASES)
            throw invalid("phaseCount is {}; it must be 1 … {}", phase_count, PHASETREE_MAX_PHASES);
        require_stride(point_stride, "pointStride");
        require_stride(phase_stride, "phaseStride");
        if (all.size() == 0) return;
        require(out, "distances");
        // One of the two strides must exceed the range of the other.
        const bool is_apart = phase_count == 1 || all.size() == 1 || point_stride / phase_count >= phase_stride ||
                              phase_stride / all.size() >= point_stride;
        if (!is_apart)
            throw invalid("pointStride {} and phaseStride {} overlap for {} phases at {} points", point_stride,
                          phase_stride, phase_count, all.size());
        write_distances(data, all, phase_count, out, point_stride, phase_stride);
    });
}
