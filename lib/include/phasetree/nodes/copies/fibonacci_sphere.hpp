#pragma once

#include "phasetree/nodes/copies/fibonacci_disk.hpp"

namespace phasetree {

/// Copies have equal shares of the sphere's area, from the north pole to the south.
template <class Child>
struct FibonacciSphere : Copies<FibonacciSphere<Child>, Child> {
    static constexpr NodeInfo info{
        "fibonacci_sphere", "7.7",
        "copies at R nᵢ, nᵢ of height 1 − (2i + 1)/n and longitude i π(3 − √5), their z axis "
        "along nᵢ; for objects, later copies replace earlier ones",
        "Copies spread evenly over a sphere along a Fibonacci spiral, each with its z axis pointing outward."};
    int count = 10;
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&FibonacciSphere::of, detail::copied);
        v(&FibonacciSphere::count, Parameter{"count", "", "Number of copies.", {.low = 1, .high = 100'000}});
        v(&FibonacciSphere::radius,
          Parameter{"radius", "m", "Radius of the sphere of the copies' origins.", limits::positive});
    }
    std::size_t many() const { return static_cast<std::size_t>(count); }
    Placement placement(std::size_t i) const {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / count, rho = std::sqrt(1 - z * z);
        const double a = detail::golden_turn(i);
        const glm::dvec3 n(rho * std::cos(a), rho * std::sin(a), z);
        return Placement::standing(glm::vec3(n * static_cast<double>(radius)), n, 0, 1);
    }
};

struct FieldFibonacciSphere : FibonacciSphere<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedFibonacciSphere : FibonacciSphere<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
