#pragma once

#include "bounding/enclosed_program.hpp"
#include "bounding/sign_certificate.hpp"
#include "kernel/linear_bound.hpp"

namespace phasetree::bounding {

using kernel::Curvature, kernel::LinearBound;

/// What is known about the interfaces in a box, apart from the ranges of values.
struct InterfaceBounds {
    LinearBound bound;
    Curvature curvature;
    Bounds box;                                    ///< encloses the interfaces; empty if no ray can meet one
    std::span<const CertificateStep> certificate;  ///< for rays in phases in which the curvature is unbounded
};

/// Derives bounds of the interfaces in a box from the enclosures of a program's values: their curvature, a linear
/// bound, a box around them, and a certificate of their sign, which is in `scratch`.
InterfaceBounds interface_bounds(const EnclosedProgram&, Arena& scratch);

}  // namespace phasetree::bounding
