// NumPy arrays of points, used without copying.
#pragma once

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <stdexcept>

namespace phasetree::python {

/// Contiguous (N, 3) floats; the package converts other arrays before the call.
using Points = pybind11::array_t<float, pybind11::array::c_style>;

inline std::size_t count_of(const Points& points, const char* what) {
    if (points.ndim() != 2 || points.shape(1) != 3)
        throw std::invalid_argument(fmt::format("{} must have the shape (N, 3)", what));
    return static_cast<std::size_t>(points.shape(0));
}

inline glm::vec3 point(const float* points, std::size_t i) {
    return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
}
inline void put(float* points, std::size_t i, const glm::vec3& p) {
    points[3 * i] = p.x;
    points[3 * i + 1] = p.y;
    points[3 * i + 2] = p.z;
}
inline bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

template <class T>
pybind11::array_t<T> array_of(std::size_t rows) {
    return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(rows));
}
template <class T>
pybind11::array_t<T> array_of(std::size_t rows, std::size_t columns) {
    return pybind11::array_t<T>({static_cast<pybind11::ssize_t>(rows), static_cast<pybind11::ssize_t>(columns)});
}

}  // namespace phasetree::python
