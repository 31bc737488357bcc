#pragma once

#include "bounding/enclosed_program.hpp"
#include "kernel/kernel.hpp"

/// Certificates that a field keeps its sign between samples along a ray. They are for fields without a bound of
/// curvature, such as a maximum at an edge, where the slope jumps upwards. A minimum stays positive where both its
/// operands do, and a maximum where either of them does throughout. So a certificate is the tree of a field's minima
/// and maxima, in postfix order, down to leaves whose curvature is bounded on at least one side. For the evaluation in
/// the kernel, and the inequalities of the leaves, see kernel/sign_certificate.inl.
namespace phasetree::bounding {

using kernel::PackedCertificateStep;

/// A step of a certificate while cells are built. It refers to a value instead of a register, and its numbers are full
/// floats. Only leaves have values and numbers.
struct CertificateStep {
    PackedCertificateStep::Kind kind = PackedCertificateStep::leaf;
    std::uint32_t value = 0;
    float threshold = 0, factor = 1, up = 0, down = 0;  ///< see PackedCertificateStep

    PackedCertificateStep packed(std::uint32_t slot) const;
};

/// A certificate that the first component of an enclosed program stays negative. With the signs of its leaves negated,
/// and `both` and `either` exchanged, it certifies that the component stays positive; a step either_one_way proves
/// nothing in that direction. Empty if no leaf has a bounded curvature, or if it would take too many steps. Allocated
/// in `scratch`.
std::span<const CertificateStep> certify_sign(const EnclosedProgram&, Arena& scratch);

}  // namespace phasetree::bounding
