#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "api/geometry_data.hpp"

namespace phasetree::embree::api {

/// Throws ApiError unless the stride, in bytes, is valid for floats.
inline void require_stride(std::size_t stride, const char* name) {
    if (stride == 0 || stride % sizeof(float) != 0)
        throw invalid("{} is {}; it must be a multiple of {} bytes", name, stride, sizeof(float));
}

/// The float i strides after the first.
inline float at(const float* first, std::size_t stride, std::size_t i) {
    float value = 0;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(first) + stride * i, sizeof value);
    return value;
}

/// The points of a call in the tree's own space: a single one, or many in any layout.
class Points {
  public:
    /// Throws ApiError if any parameter is invalid, before anything is written.
    Points(const GeometryData& data, const PhasetreePoints* points) : data_(data), p_(checked(points)) {
        const bool moves = !data.motion.none() && p_.time;
        if (!moves && p_.count > 0) still_ = placement_at(data, 0);
        for (std::size_t i = 0; i < p_.count; ++i) {
            const glm::vec3 p = given(i);
            for (int axis = 0; axis < 3; ++axis)
                if (!std::isfinite(p[axis])) throw invalid("point {} has an entry that is not finite", i);
            if (p_.time && !std::isfinite(time(i))) throw invalid("the time of point {} is not finite", i);
            if (moves) (void)placement(i);
        }
    }
    /// A single point, as given by the application. Its time is ignored if nothing moves.
    Points(const GeometryData& data, const float* point, float time) : data_(data), still_(placement_at(data, time)) {
        read_point(point);
        phasetreeInitPoints(&p_);
        p_.count = 1;
        p_.x = point;
        p_.y = point + 1;
        p_.z = point + 2;
    }
    std::size_t size() const { return p_.count; }
    Placement placement(std::size_t i) const { return still_ ? *still_ : placement_at(data_, time(i)); }
    glm::vec3 operator[](std::size_t i) const {
        return data_.motion.none() ? given(i) : placement(i).point_within(given(i));
    }

    /// Calls f(index of the first point, number of points, their coordinates) with eight at a time; the last batch is
    /// filled with copies of the last point.
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
    PhasetreePoints p_{};
    std::optional<Placement> still_;
};

}  // namespace phasetree::embree::api
