#pragma once

#include "bounding/enclosed_program.hpp"
#include "kernel/kernel.hpp"

/// Certificates that a field keeps its sign between samples along a ray, for fields whose curvature has no bound: a
/// maximum has none at an edge, where its slope jumps upward. But a minimum stays positive where both its operands do,
/// and a maximum where one of them does at each point. So a certificate is the tree of a field's minima and maxima, in
/// postfix order, down to leaves whose curvature is bounded on one side at least. How the kernel evaluates it, and the
/// inequalities of the leaves: kernel/sign_certificate.inl.
namespace phasetree::bounding {

using kernel::PackedCertificateStep;

/// A step of a certificate while cells are built. It refers to a value where the packed step has a register, and its
/// numbers are floats of full length. Only leaves have values and numbers.
struct CertificateStep {
    PackedCertificateStep::Kind kind = PackedCertificateStep::leaf;
    std::uint32_t value = 0;
    float threshold = 0, factor = 1, up = 0, down = 0;  ///< see PackedCertificateStep

    PackedCertificateStep packed(std::uint32_t slot) const;
};

/// A certificate that the first component of an enclosed program stays negative. With the signs of its leaves negated,
/// and `both` and `either` exchanged, it is one that the component stays positive; but a step either_one_way proves
/// nothing in that direction. Empty if there is no leaf with a bounded curvature, or if it would take too many steps.
/// It is in `scratch`.
std::span<const CertificateStep> certify_sign(const EnclosedProgram&, Arena& scratch);

}  // namespace phasetree::bounding
