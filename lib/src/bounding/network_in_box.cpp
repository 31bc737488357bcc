#include "bounding/network_in_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evaluation/target.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/fields/siren.hpp"

namespace phasetree::bounding {

using enclosure::limited, enclosure::Interval;
using evaluation::active_kernel;
using kernel::absolute_lane, kernel::network_lanes;

namespace {

// A neuron's Taylor polynomial: its value and its 3 first, 6 second and 10 third partial derivatives, in the order xx,
// xy, xz, yy … All of these are linear in the inputs of a layer. The last number is an upper bound on the fourth
// derivatives, which a layer combines using the absolute values of the weights.
struct alignas(64) Jet {
    std::array<double, network_lanes> all;

    double& value() { return all[0]; }
    double* first() { return all.data() + 1; }
    double* second() { return all.data() + 4; }
    double* third() { return all.data() + 10; }
    double& fourth() { return all[absolute_lane]; }
};
// The index of the derivative by axes i and j is second_index[i][j]; by i, j and k it is
// third_index[i][second_index[j][k]].
constexpr std::size_t second_index[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
constexpr std::size_t third_index[3][6] = {{0, 1, 2, 3, 4, 5}, {1, 3, 4, 6, 7, 8}, {2, 4, 5, 7, 8, 9}};

// The Frobenius norm of the derivatives of one order, which bounds them along every line of unit speed.
double norm1(const double* g) {
    return std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}
double norm2(const double* h) {
    return std::sqrt(h[0] * h[0] + h[3] * h[3] + h[5] * h[5] + 2 * (h[1] * h[1] + h[2] * h[2] + h[4] * h[4]));
}
double norm3(const double* t) {
    const auto square = [&](std::size_t i) { return t[i] * t[i]; };
    const double mixed = square(1) + square(2) + square(3) + square(5) + square(7) + square(8);
    return std::sqrt(square(0) + square(6) + square(9) + 3 * mixed + 6 * square(4));
}

// The range of the eigenvalues of a symmetric matrix (Smith, "Eigenvalues of a symmetric 3 × 3 matrix", 1961).
Interval eigenvalues(const double* h) {
    const double mean = (h[0] + h[3] + h[5]) / 3;
    const double a = h[0] - mean, b = h[3] - mean, c = h[5] - mean, xy = h[1], xz = h[2], yz = h[4];
    const double p = std::sqrt((a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6);
    if (!(p > 0)) return {mean, mean};
    const double determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    const double angle = portable::acos(std::clamp(determinant / (2 * p * p * p), -1.0, 1.0)) / 3;
    const double rounding_error = 1e-7 * (p + std::abs(mean));  // near ±1, acos has half of the digits
    return {mean + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3) - rounding_error,
            mean + 2 * p * std::cos(angle) + rounding_error};
}

// Replaces the polynomial of z with that of sin z, in a box of this radius.
void activate(Jet& z, double radius) {
    const double q = z.fourth();
    const double sine = std::sin(z.value()), cosine = std::cos(z.value());
    double *first = z.first(), *second = z.second(), *third = z.third();
    const double n1 = norm1(first), n2 = norm2(second), n3 = norm3(third);
    // The bounds t, k and g of the third, second and first derivatives in the box (see the header).
    const double t = n3 + radius * q;
    const double k = n2 + radius * (n3 + radius / 2 * q);
    const double g = n1 + radius * (n2 + radius / 2 * (n3 + radius / 3 * q));
    const double largest_sine = std::min(1.0, std::abs(sine) + g * radius);
    const double largest_cosine = std::min(1.0, std::abs(cosine) + g * radius);

    const std::array<double, 3> by{first[0], first[1], first[2]};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j)
            for (std::size_t l = j; l < 3; ++l) {
                const double products = by[i] * second[second_index[j][l]] + by[j] * second[second_index[i][l]] +
                                        by[l] * second[second_index[i][j]];
                double& d = third[third_index[i][second_index[j][l]]];
                d = cosine * (d - by[i] * by[j] * by[l]) - sine * products;
            }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) {
            double& d = second[second_index[i][j]];
            d = cosine * d - sine * by[i] * by[j];
        }
    for (std::size_t i = 0; i < 3; ++i) first[i] *= cosine;
    z.value() = sine;
    z.fourth() = largest_cosine * (q + 6 * g * g * k) + largest_sine * (4 * g * t + 3 * k * k + g * g * g * g);
}

}  // namespace

FieldInBox network_in_box(const float* data, const std::array<double, 3>& centre, const std::array<double, 3>& half) {
    const double radius = norm1(half.data());
    std::array<Jet, SirenNetwork::widest> layer_in, layer_out;
    Jet *in = layer_in.data(), *out = layer_out.data();
    for (std::size_t i = 0; i < 3; ++i) {
        in[i] = {};
        in[i].value() = centre[i];
        in[i].first()[i] = 1;
    }
    const int layers = static_cast<int>(data[0]);
    const float* at = data + 2;
    for (int layer = 0; layer < layers; ++layer) {
        const auto inputs = static_cast<std::size_t>(at[0]), outputs = static_cast<std::size_t>(at[1]);
        const float *weights = at + 2, *bias = weights + inputs * outputs;
        active_kernel().network_layer(weights, bias, inputs, outputs, in->all.data(), out->all.data());
        if (layer + 1 < layers)
            for (std::size_t o = 0; o < outputs; ++o) activate(out[o], radius);
        std::swap(in, out);
        at = bias + outputs;
    }

    Jet& f = *in;
    constexpr double margin = 1 + 1e-9;
    const double fourth = f.fourth() * margin;
    FieldInBox result;
    result.value = f.value();
    for (std::size_t i = 0; i < 3; ++i) {
        // A symmetric multilinear form is largest where all its arguments are equal (Banach, 1938). So a bound along
        // lines also bounds the mixed derivatives.
        double change = fourth * radius * radius * radius / 6;
        for (std::size_t j = 0; j < 3; ++j) {
            change += std::abs(f.second()[second_index[i][j]]) * half[j];
            for (std::size_t l = 0; l < 3; ++l)
                change += 0.5 * std::abs(f.third()[third_index[i][second_index[j][l]]]) * half[j] * half[l];
        }
        result.gradient[i] = f.first()[i];
        result.gradients[i] = limited(result.gradient[i] - change * margin, result.gradient[i] + change * margin);
    }
    const Interval at_centre = eigenvalues(f.second());
    const double change = radius * (norm3(f.third()) + radius / 2 * fourth) * margin;
    result.curvature = limited(at_centre.low - change, at_centre.high + change);
    return result;
}

}  // namespace phasetree::bounding

namespace phasetree {

std::optional<enclosure::Enclosure> Siren::Network::enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                             const std::array<double, 3>&) {
    const enclosure::Region at(q);
    // The second number of the data is half the side of the cube. Points beyond the cube are projected onto it.
    if (!(at.farthest() < static_cast<double>(data[1]))) return std::nullopt;
    return enclose(bounding::network_in_box(data, at.centre, at.half_extents), at);
}

}  // namespace phasetree
