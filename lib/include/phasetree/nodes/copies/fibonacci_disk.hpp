#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

namespace detail {
/// π(3 − √5), by which consecutive points of a Fibonacci spiral are turned.
inline constexpr double golden_angle = 2.39996322972865332;
}  // namespace detail

/// The points of a sunflower: equal shares of the disk's area, no two in one direction.
template <class Child>
struct FibonacciDisk : Copies<Child> {
    static constexpr NodeInfo info{"fibonacci_disk", "7.7",
                                   "copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); of objects, the later over the "
                                   "earlier",
                                   "Copies spread evenly over a disk about the z axis, on a Fibonacci spiral."};
    int count = 10;
    float radius = 1;
    int turned = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&FibonacciDisk::of, detail::copied);
        v(&FibonacciDisk::count, Parameter{"count", "", "How many.", {.low = 1, .high = 100'000}});
        v(&FibonacciDisk::radius,
          Parameter{"radius", "m", "Of the disk that the copies' origins share.", limits::positive});
        v(&FibonacciDisk::turned,
          Parameter{"turned", "", "1: each copy's x axis points away from the middle.", {.low = 0, .high = 1}, true});
    }
    void prepare() {
        this->placements.clear();
        for (int i = 0; i < count; ++i) {
            const double r = static_cast<double>(radius) * std::sqrt((i + 0.5) / count);
            const double a = std::fmod(i * detail::golden_angle, 2 * 3.14159265358979323846);
            this->placements.push_back(
                Placement::at(glm::vec3(r * std::cos(a), r * std::sin(a), 0), turned == 1 ? glm::degrees(a) : 0, 1));
        }
    }
};

struct FieldFibonacciDisk : FibonacciDisk<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedFibonacciDisk : FibonacciDisk<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
