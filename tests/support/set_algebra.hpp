#pragma once

/// An oracle: the meaning of every node, implemented a second time, in double, from the definitions of the sets (paper,
/// Sections 3 to 6) and textbook inequalities of the primitives. It shares no equation with the library.
///
///     inside(f, p), label(a, p)   plain Boolean set algebra: &&, ||, !, "the later object replaces", inverse
///                                 transforms
///     value(f, p), values(a, p)   fields as numbers, for those nodes whose very meaning is one (offset, shell, smooth
///                                 operators, thin_shell, layered), and as an independent reference of φ
///
/// set_algebra.cpp dispatches over the library's variants without a default case: a node added to the list does not
/// compile there until one of the files in set_algebra/ knows it.

#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "phasetree/model/handle.hpp"

namespace phasetree::tests {

inline constexpr double absent = std::numeric_limits<double>::infinity();

/// Φ in double, an absent phase being infinite. The index is the phase's.
struct Components {
    std::array<double, 16> phi;

    Components() { phi.fill(absent); }
    double& operator[](std::size_t i) { return phi.at(i); }
    double operator[](std::size_t i) const { return phi.at(i); }
    static constexpr std::size_t size = 16;

    /// The second smallest component: the label does not change within that distance.
    double interface_distance() const {
        double first = absent, second = absent;
        for (const double v : phi) {
            second = std::min(second, std::max(first, v));
            first = std::min(first, v);
        }
        return second;
    }
};

bool inside(const Field&, const glm::dvec3&);
Phase label(const Phased&, const glm::dvec3&);
double value(const Field&, const glm::dvec3&);
Components values(const Phased&, const glm::dvec3&);

namespace oracle {
using glm::dvec3;

inline double square(double x) {
    return x * x;
}
}  // namespace oracle

}  // namespace phasetree::tests
