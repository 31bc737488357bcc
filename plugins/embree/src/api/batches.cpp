/// Many points at once: eight are evaluated together.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "api/geometry_data.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::embree::api {

namespace {

void require_stride(std::size_t stride, const char* name) {
    if (stride == 0 || stride % sizeof(float) != 0)
        throw invalid("{} is {}; it must be a multiple of {} bytes", name, stride, sizeof(float));
}

float at(const float* first, std::size_t stride, std::size_t i) {
    float value = 0;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(first) + stride * i, sizeof value);
    return value;
}

/// The points of a call in the tree's own space.
class Points {
  public:
    /// Throws ApiError if any is not what it must be, so that nothing is written then.
    Points(const GeometryData& data, const PhasetreePoints* points) : data_(data), p_(checked(points)) {
        const bool moves = !data.motion.none() && p_.time;
        if (!moves && p_.count > 0) still_ = placement_at(data, 0);
        for (std::size_t i = 0; i < p_.count; ++i) {
            const glm::vec3 p = given(i);
            for (int axis = 0; axis < 3; ++axis)
                if (!std::isfinite(p[axis])) throw invalid("point {} has an entry that is no finite number", i);
            if (p_.time && !std::isfinite(time(i))) throw invalid("the time of point {} is no finite number", i);
            if (moves) (void)placement(i);
        }
    }
    std::size_t size() const { return p_.count; }
    Placement placement(std::size_t i) const { return still_ ? *still_ : placement_at(data_, time(i)); }
    glm::vec3 operator[](std::size_t i) const {
        return data_.motion.none() ? given(i) : placement(i).point_within(given(i));
    }

    /// Calls f(index of the first point, how many, their coordinates): eight at a time, the last one repeated.
    template <class F>
    void each_batch(F&& f) const {
        for (std::size_t first = 0; first < size(); first += batch_size) {
            const std::size_t count = std::min(batch_size, size() - first);
            std::array<BatchOfFloats, 3> batch;
            for (std::size_t i = 0; i < batch_size; ++i) {
                const glm::vec3 p = (*this)[first + std::min(i, count - 1)];
                for (int axis = 0; axis < 3; ++axis) batch[static_cast<std::size_t>(axis)][i] = p[axis];
            }
            f(first, count, batch);
        }
    }

  private:
    static PhasetreePoints checked(const PhasetreePoints* points) {
        require(points, "points");
        if (points->count == 0) return {};
        require(points->x, "points->x");
        require(points->y, "points->y");
        require(points->z, "points->z");
        require_stride(points->stride, "points->stride");
        if (points->time && points->timeStride != 0) require_stride(points->timeStride, "points->timeStride");
        return *points;
    }
    glm::vec3 given(std::size_t i) const {
        return {at(p_.x, p_.stride, i), at(p_.y, p_.stride, i), at(p_.z, p_.stride, i)};
    }
    float time(std::size_t i) const { return at(p_.time, p_.timeStride, i); }

    const GeometryData& data_;
    PhasetreePoints p_;
    std::optional<Placement> still_;
};

/// Φ at each point of a batch.
std::array<Phases<float>, batch_size> distances(const Evaluator& whole, const std::array<BatchOfFloats, 3>& batch,
                                                std::vector<BatchOfFloats>& room) {
    const auto& outputs = whole.program().outputs;
    room.resize(outputs.size());
    whole.evaluate(batch[0], batch[1], batch[2], room, Evaluator::thread_workspace());
    std::array<Phases<float>, batch_size> all;
    for (std::size_t i = 0; i < batch_size; ++i)
        for (std::size_t k = 0; k < outputs.size(); ++k) all[i].set(outputs[k].phase.index, room[k][i]);
    return all;
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeGetPhaseN(PhasetreeGeometry geometry, const PhasetreePoints* points, unsigned int* phases,
                                  float* empty_radii) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        const Points all(data, points);
        if (all.size() > 0) require(phases, "phases");
        const InterfaceCells& cells = data.object->cells();
        const FlushSubnormals flush;
        std::vector<BatchOfFloats> room;
        all.each_batch([&](std::size_t first, std::size_t count, const std::array<BatchOfFloats, 3>& batch) {
            const auto phi = distances(cells.whole(), batch, room);
            Samples s;
            if (empty_radii) cells.whole().sample(batch[0], batch[1], batch[2], s, Evaluator::thread_workspace());
            for (std::size_t i = 0; i < count; ++i) {
                const glm::vec3 p{batch[0][i], batch[1][i], batch[2][i]};
                phases[first + i] = cells.bounds().contains(p) ? label(phi[i]).index : vacuum.index;
                if (empty_radii)
                    empty_radii[first + i] = radius_without_interface(data, p, s.distance[i], all.placement(first + i));
            }
        });
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
        // One of them steps over all that the other reaches.
        const bool is_apart = phase_count == 1 || all.size() == 1 || point_stride / phase_count >= phase_stride ||
                              phase_stride / all.size() >= point_stride;
        if (!is_apart)
            throw invalid("pointStride {} and phaseStride {} overlap for {} phases at {} points", point_stride,
                          phase_stride, phase_count, all.size());
        const FlushSubnormals flush;
        std::vector<BatchOfFloats> room;
        all.each_batch([&](std::size_t first, std::size_t count, const std::array<BatchOfFloats, 3>& batch) {
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
    });
}
