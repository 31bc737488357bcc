#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/linear_bound.hpp"
#include "phasetree/model/phase.hpp"
#include "phasetree/model/ray.hpp"

namespace phasetree {

/// A certificate is no longer than this.
inline constexpr std::size_t most_certificate_steps = 32;

/// A resolved instruction. Slots count batches in the register file; a point takes three. Where its constants are is
/// kept apart, so that many routines share their steps.
struct Step {
    std::uint32_t op;
    std::uint32_t to;
    std::uint32_t a;
    std::uint32_t b;

    bool operator==(const Step&) const = default;
};

/// Where a component is found after the steps: sign (1 or −1) times the slot's value.
struct OutputSlot {
    std::uint32_t slot;
    float phase;
    float sign;

    bool operator==(const OutputSlot&) const = default;
};

/// A step of a certificate, on a stack, that a field keeps its sign between samples: see certificate.inl. A leaf speaks
/// of
///     g = factor · (the slot's value − threshold),
/// which is 1-Lipschitz; 16-bit numbers are the upper halves of floats.
struct PackedCertificateStep {
    enum Kind : std::uint32_t { leaf, both, either, either_one_way };

    float threshold;
    std::uint32_t slot : 30, kind : 2;
    std::uint16_t factor;
    std::uint16_t up, down;  ///< how much g and −g curve upward at most, infinite if that is not known
    std::uint16_t unused = 0;

    bool operator==(const PackedCertificateStep&) const = default;
};

/// What a kernel runs: plain pointers, because kernels are compiled for several instruction sets and must not share
/// inline functions of the standard library with the rest.
struct Routine {
    const Step* steps;
    const std::uint32_t* data;  ///< for each step where its constants are among these:
    const float* constants;
    std::size_t count;
    const OutputSlot* outputs;
    std::size_t output_count;
    /// Which lower bound of the distance to where the label changes is used where each component has a value of its
    /// own: minus the label's component, or the least of the others'.
    bool is_by_own = false;
    /// One value tells where rays may be and where not: that of two phases, or the first, if no ray is in the others.
    bool is_by_first = false;
    /// So many steps give the first component alone, 0 if that is not known: enough for a ray that is in its phase.
    std::size_t leading = 0;
    /// Of the first component, where its curvature is not known: that it stays negative.
    const PackedCertificateStep* certificate = nullptr;
    std::size_t certificate_steps = 0;
};

/// Routines that need no more batches bring no registers.
inline constexpr std::uint32_t few_slots = 48;

/// A cell that a ray visits, or a whole object.
struct Visit {
    const Bounds* box;
    const LinearBound* bound;
    const Routine* routine;
    const TracedRay* ray;
    float* registers;  ///< for the routine's batches, or null for few of them
    float
        curvature[2];  ///< as Curvature: of the distance along the ray, in the phase of the first output and in others
    float t_min, t_max;
    float resolution;
    float carried;  ///< the phase that the ray is in; negative: the label at its start
    float rise;     ///< of a LeavingHint, or none
    /// Where an unfinished search goes on, counted from where it began: a place in the ray's phase; or 0.
    float from = 0;

    static constexpr float no_leaving_hint = -2;
};

/// The first change of label there; see Crossing. Without one, only what it cost.
struct RayCrossing {
    double start;     ///< how far along the ray this is, where the search began:
    float origin[3];  ///< and from there
    float t_in, t_out;
    float from, to;
    std::uint32_t batches, phantoms;
    /// It was given up for now: no change was found up to t_in, which is in the phase `from`. See trace/creep.hpp.
    bool is_unfinished;
    float length;  ///< of what is searched
};

/// Of a neuron's numbers in network_layer().
inline constexpr std::size_t network_lanes = 24, absolute_lane = 20;

/// A kernel: the same functions for one instruction set. Slot 0 … 2 is the input point.
struct Kernel {
    void (*evaluate)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* out);
    void (*sample)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* label,
                   float* distance);
    void (*sample_ray)(const Routine&, const float* origin, const float* direction, const float* t, float* registers,
                       float* label, float* distance);
    /// Whether the label changes where the ray is in the box, and where first: visit.inl.
    bool (*visit)(const Visit&, RayCrossing&);
    /// A linear layer of a network whose neurons have several lanes: network_layer.inl.
    void (*network_layer)(const float* weights, const float* bias, std::size_t inputs, std::size_t outputs,
                          const double* in, double* out);
};

extern const Kernel kernel_baseline;
#ifdef PHASETREE_X86
extern const Kernel kernel_sse4;
extern const Kernel kernel_avx2;
extern const Kernel kernel_avx512;
#endif

}  // namespace phasetree
