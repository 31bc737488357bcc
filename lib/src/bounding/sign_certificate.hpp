#pragma once

#include <span>

#include "kernel/kernel.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::enclosure {
struct Enclosure;
}

namespace phasetree::bounding {

using enclosure::Enclosure;
using kernel::PackedCertificateStep;
using rewriting::Arena, rewriting::WorkingProgram;

/// A step of a certificate (kernel/sign_certificate.inl) in the course of its making: in numbers of full length, and
/// with the number of a value for its slot. Only leaves have one.
struct CertificateStep {
    PackedCertificateStep::Kind kind = PackedCertificateStep::leaf;
    std::uint32_t value = 0;
    float threshold = 0, factor = 1, up = 0, down = 0;

    PackedCertificateStep step(std::uint32_t slot) const;
};

/// How to prove that a program's first component stays negative where its curvature is not known, from the enclosures
/// of its values in a box; those of the same program, one for each slot. Nothing if no leaf's curvature is known, or if
/// it takes too many. The result is in `scratch`.
std::span<const CertificateStep> certify_sign(const WorkingProgram&, std::span<const float> constants,
                                              const Enclosure* registers, std::span<const std::uint32_t> slot,
                                              Arena& scratch);

}  // namespace phasetree::bounding
