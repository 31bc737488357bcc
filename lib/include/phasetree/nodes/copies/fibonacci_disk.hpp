#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

namespace detail {
/// The angle of point i of a Fibonacci spiral; each is rotated by π(3 − √5) from the previous one.
inline double golden_turn(std::size_t i) {
    return std::fmod(static_cast<double>(i) * 2.39996322972865332, 2 * 3.14159265358979323846);
}
}  // namespace detail

/// The pattern of a sunflower's seeds: copies have equal shares of the disk's area, and no two are in the same
/// direction.
template <class Child>
struct FibonacciDisk : Copies<FibonacciDisk<Child>, Child> {
    static constexpr NodeInfo info{
        "fibonacci_disk", "7.7",
        "copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); for objects, later copies replace earlier ones",
        "Copies spread evenly over a disk about the z axis, on a Fibonacci spiral."};
    int count = 10;
    float radius = 1;
    int turned = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&FibonacciDisk::of, detail::copied);
        v(&FibonacciDisk::count, Parameter{"count", "", "Number of copies.", {.low = 1, .high = 100'000}});
        v(&FibonacciDisk::radius,
          Parameter{"radius", "m", "Radius of the disk of the copies' origins.", limits::positive});
        v(&FibonacciDisk::turned, Parameter{"turned",
                                            "",
                                            "1: each copy is rotated so that its x axis points away from the centre; "
                                            "0: all copies have the same orientation.",
                                            {.low = 0, .high = 1},
                                            true});
    }
    std::size_t many() const { return static_cast<std::size_t>(count); }
    Placement placement(std::size_t i) const {
        const double r = static_cast<double>(radius) * std::sqrt((static_cast<double>(i) + 0.5) / count);
        const double a = detail::golden_turn(i);
        return Placement::at(glm::vec3(r * std::cos(a), r * std::sin(a), 0), turned == 1 ? glm::degrees(a) : 0, 1);
    }
};

struct FieldFibonacciDisk : FibonacciDisk<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedFibonacciDisk : FibonacciDisk<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
