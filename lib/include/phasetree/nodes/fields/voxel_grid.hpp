#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/math/found_equation.hpp"
#include "phasetree/math/number.hpp"
#include "phasetree/math/vec3.hpp"
#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// The positions of a grid's voxels: their number along x, y and z, the centre of the first one, and the spacing.
struct VoxelLattice {
    std::array<int, 3> size{};
    glm::dvec3 first{0};
    glm::dvec3 spacing{1};
};

/// Values at the centres of voxels, in blocks of 8³. Each block is stored with its adjacent voxels, 10³ values, so that
/// every interpolation reads a single block. Blocks whose values are all equal are stored as one value. The table is
/// the data of a program's instruction, so all code that reads it receives floats:
///
///     the number of voxels, then of blocks, along x, y and z; the first voxel's centre; 1/spacing
///     for each block, x fastest: its index among the stored blocks, or −1; its minimum and maximum, which are equal
///         if all its values are
///     the values of the stored blocks, x fastest, each with one layer of voxels around it
///
/// Beyond its border voxels the grid continues with their values.
struct VoxelGrid {
    static constexpr int block_side = 8, kept_side = 10;
    static constexpr std::size_t kept_values = 1000;
    /// The maxima that file readers and nodes accept: the number of stored values (half a gigabyte), and of voxels
    /// along an axis.
    static constexpr std::size_t max_values = 120'000'000;
    static constexpr int max_along_axis = 8192;

    VoxelLattice lattice{};
    std::vector<float> table{};
    /// The values in the table are the original ones divided by this number.
    double divided_by = 1;

    /// Make a grid from the values of its blocks, which are requested in order. `fill` receives the indices of a
    /// block's lowest voxel, minus 1 along each axis, and a buffer for the 10³ values from there on. For voxels outside
    /// the grid it must return those at the border. Throws ModelError if there are too many values or one is not
    /// finite; the message starts with `who`.
    using Fill = std::function<void(const std::array<int, 3>& before, std::span<float, kept_values>)>;
    static VoxelGrid make(std::string_view who, const VoxelLattice&, const Fill& fill);
    /// The same from f(x, y, z), the value at a voxel.
    template <class F>
    static VoxelGrid of_voxels(std::string_view who, const VoxelLattice& lattice, F&& f) {
        return make(who, lattice, [&](const std::array<int, 3>& before, std::span<float, kept_values> values) {
            std::array<std::array<int, kept_side>, 3> index;
            for (std::size_t a = 0; a < 3; ++a)
                for (int i = 0; i < kept_side; ++i)
                    index[a][static_cast<std::size_t>(i)] = std::max(std::min(before[a] + i, lattice.size[a] - 1), 0);
            float* to = values.data();
            for (const int z : index[2])
                for (const int y : index[1])
                    for (const int x : index[0]) *to++ = static_cast<float>(f(x, y, z));
        });
    }

    /// The same from the values of all voxels, x fastest. Uses all threads.
    static VoxelGrid of_values(std::string_view who, const VoxelLattice&, std::span<const float> values);

    /// The maximum slope of linear(), and a bound on that of spline(). Uses all threads.
    double steepest_linear() const;
    double steepest_spline() const;
    /// Divide all values by a positive number. Uses all threads.
    void divide_by(double);

    /// The maximum value of a voxel.
    float greatest() const;
    /// Move all voxels so that the centre of the first one is at this point.
    void move_first_to(const glm::dvec3&);

    /// Returns a box around all points whose value depends on a voxel of a block that contains a value of at most
    /// `level`; empty if there are none.
    Bounds blocks_below(float level) const;
    /// The box of all voxels: half a voxel beyond the outermost centres on every side.
    Bounds extent() const;

    std::size_t bytes() const { return table.size() * sizeof(float); }
};

namespace voxels {

/// Offsets in the table.
inline constexpr std::size_t size = 0, blocks = 3, first = 6, inverse_spacing = 9, head = 12, entry = 3;
/// Offsets in the directory entry of a block: the minimum and the maximum of the values from which its points are
/// interpolated. (The first number of an entry locates the block's values.)
inline constexpr std::size_t least_of_block = 1, greatest_of_block = 2;

/// The table, prepared for looking up voxels by integer indices.
struct Table {
    const float* directory;
    const float* values;
    std::array<int, 3> size, blocks;

    explicit Table(const float* data);
    float operator()(int x, int y, int z) const;
    /// The entry of the block that contains a voxel.
    const float* block_of(int x, int y, int z) const;
};

/// The size of features in a grid: a few voxels.
inline float feature_size(const float* data) {
    return 6.f / max(data[inverse_spacing], max(data[inverse_spacing + 1], data[inverse_spacing + 2]));
}

/// The numbers from which the value at a point is computed: the three indices of the first voxel (linear) or of the
/// middle one (spline), and the values of the 8 or 27 voxels around the point, x fastest. N is float if they were
/// looked up for one point. In batches and shaders it is the number type of the equation, because the voxels differ
/// between lanes, or are looked up only while the shader runs.
template <class N>
using EightVoxels = std::array<N, 3 + 8>;
template <class N>
using TwentySevenVoxels = std::array<N, 3 + 27>;

/// Look up these numbers for a point, and write them to to[0], to[stride], …: the search of gathered_equation()
/// (math/found_equation.hpp).
void gather_eight(const float* data, const Vec3<float>&, float* to, std::size_t stride);
void gather_twenty_seven(const float* data, const Vec3<float>&, float* to, std::size_t stride);

/// A coordinate in voxels from the centre of the first one, clamped to at most `beyond` outside the centres.
template <class T>
[[gnu::always_inline]] inline T place(const float* data, std::size_t axis, const T& coordinate, float beyond) {
    return clamp((coordinate - data[first + axis]) * data[inverse_spacing + axis], T(-beyond),
                 T(data[size + axis] - 1.f + beyond));
}
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> places(const float* data, const Vec3<T>& p, float beyond) {
    return {place(data, 0, p.x, beyond), place(data, 1, p.y, beyond), place(data, 2, p.z, beyond)};
}

/// The index of the first of two voxels around a coordinate; at the border, at most the last but one.
template <class T>
[[gnu::always_inline]] inline T first_of_two(const float* data, std::size_t axis, const T& at) {
    return max(min(floor(at), T(data[size + axis] - 2.f)), T(0.f));
}
template <class T>
[[gnu::always_inline]] inline T middle_of_three(const float* data, std::size_t axis, const T& at) {
    return min(floor(at + 0.5f), T(data[size + axis] - 1.f));
}

/// The trilinear interpolation. It is continuous, and has the voxels' values at their centres.
template <class T, class N>
[[gnu::always_inline]] inline T linear(const EightVoxels<N>& at, const float* data, const Vec3<T>& p) {
    const std::array<T, 3> u = places(data, p, 0.f);
    const T x = u[0] - at[0], y = u[1] - at[1], z = u[2] - at[2];
    std::array<T, 4> along_x;
    for (std::size_t i = 0; i < 4; ++i) along_x[i] = x * (at[2 * i + 4] - at[2 * i + 3]) + at[2 * i + 3];
    const T low = (along_x[1] - along_x[0]) * y + along_x[0], high = (along_x[3] - along_x[2]) * y + along_x[2];
    return (high - low) * z + low;
}

/// The triquadratic B-spline. It is smooth: its slopes are continuous.
template <class T, class N>
[[gnu::always_inline]] inline T spline(const TwentySevenVoxels<N>& at, const float* data, const Vec3<T>& p) {
    const std::array<T, 3> u = places(data, p, 0.5f);
    std::array<std::array<T, 3>, 3> weight;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T t = u[axis] - at[axis], before = 0.5f - t, behind = t + 0.5f;
        weight[axis] = {before * before * 0.5f, 0.75f - t * t, behind * behind * 0.5f};
    }
    T sum(0.f);
    for (std::size_t k = 0; k < 3; ++k) {
        T slice(0.f);
        for (std::size_t j = 0; j < 3; ++j) {
            const N* v = &at[3 + 9 * k + 3 * j];
            slice = slice + (weight[0][0] * v[0] + weight[0][1] * v[1] + weight[0][2] * v[2]) * weight[1][j];
        }
        sum = sum + slice * weight[2][k];
    }
    return sum;
}

/// The value of the voxel with the indices x, y, z, for shaders: the indices are known only while the shader runs.
template <class T>
T looked_up(const float* data, const T& x, const T& y, const T& z) {
    const auto block = [](const T& i) { return floor(i * 0.125f); };
    const T bx = block(x), by = block(y), bz = block(z);
    const T number = bx + (by + bz * data[blocks + 1]) * data[blocks];
    const float* directory = data + head;
    const float* values =
        directory + entry * static_cast<std::size_t>(data[blocks] * data[blocks + 1] * data[blocks + 2]);
    const T own = lookup(directory, number * 3.f);
    const T within = ((x + 1.f) - bx * 8.f) + (((y + 1.f) - by * 8.f) + ((z + 1.f) - bz * 8.f) * 10.f) * 10.f;
    return select(less(own, T(0.f)), lookup(directory + 1, number * 3.f),
                  lookup(values, max(own, T(0.f)) * 1000.f + within));
}

/// The data, if it is small enough for a shader; otherwise throws ModelError with a message that starts with `who`.
const float* for_shader(std::string_view who, const float* data);

/// Interpolate the table of a grid (VoxelGrid) linearly, as a primitive.
template <class T>
T linear_at(const float* data, const Vec3<T>& p) {
    return gathered_equation<3 + 8>(
        p, [&](const Vec3<float>& q, float* to, std::size_t stride) { gather_eight(data, q, to, stride); },
        [&](const auto& at, const auto& q) { return linear(at, data, q); },
        [&](const auto& q) {
            using Number = std::remove_cvref_t<decltype(q.x)>;
            for_shader("volume", data);
            const std::array<Number, 3> u = places(data, q, 0.f);
            EightVoxels<Number> at;
            for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = first_of_two(data, axis, u[axis]);
            for (std::size_t i = 0; i < 8; ++i) {
                std::array<Number, 3> index;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    index[axis] = min(at[axis] + static_cast<float>((i >> axis) & 1), Number(data[size + axis] - 1.f));
                at[3 + i] = looked_up(data, index[0], index[1], index[2]);
            }
            return linear(at, data, q);
        });
}

/// The same with splines.
template <class T>
T spline_at(const float* data, const Vec3<T>& p) {
    return gathered_equation<3 + 27>(
        p, [&](const Vec3<float>& q, float* to, std::size_t stride) { gather_twenty_seven(data, q, to, stride); },
        [&](const auto& at, const auto& q) { return spline(at, data, q); },
        [&](const auto& q) {
            using Number = std::remove_cvref_t<decltype(q.x)>;
            for_shader("labels", data);
            const std::array<Number, 3> u = places(data, q, 0.5f);
            TwentySevenVoxels<Number> at;
            std::array<std::array<Number, 3>, 3> index;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Number middle = at[axis] = middle_of_three(data, axis, u[axis]);
                index[axis] = {max(middle - 1.f, Number(0.f)), middle,
                               min(middle + 1.f, Number(data[size + axis] - 1.f))};
            }
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t i = 0; i < 3; ++i)
                        at[3 + 9 * k + 3 * j + i] = looked_up(data, index[0][i], index[1][j], index[2][k]);
            return spline(at, data, q);
        });
}

}  // namespace voxels

/// The file of a level set, as the node `volume` reads it.
template <>
struct FileFormat<VoxelGrid> {
    static constexpr std::string_view no_reader = "this program cannot read OpenVDB files";
};

}  // namespace phasetree
