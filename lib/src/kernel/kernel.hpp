#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/linear_bound.hpp"
#include "phasetree/model/phase.hpp"
#include "phasetree/model/ray.hpp"

namespace phasetree::kernel {

/// The largest number of steps of a sign certificate.
inline constexpr std::size_t most_certificate_steps = 32;

/// If a ray enters a cell in another phase than it carries, the search looks back this many resolutions for the change
/// (InterfaceCells::look_back).
inline constexpr float look_back_resolutions = 4;

/// An instruction that is ready to run. Slots count batches among the registers; a point takes three. The offsets of
/// the constants are stored separately (Routine::data), so that routines that differ only in constants can share their
/// steps.
struct Step {
    std::uint32_t op;  ///< an Op
    std::uint32_t to;  ///< the slot of the result
    std::uint32_t a;   ///< the slots of the operands
    std::uint32_t b;

    bool operator==(const Step&) const = default;
};

/// Where to find a component after the steps have run: it is the slot's value times `sign`, which is 1 or −1.
struct OutputSlot {
    std::uint32_t slot;
    float phase;
    float sign;

    bool operator==(const OutputSlot&) const = default;
};

/// A step of a certificate that a field keeps its sign between samples, in postfix order: see sign_certificate.inl. A
/// leaf is the field
///     g = factor · (the slot's value − threshold),
/// which is 1-Lipschitz. 16-bit numbers are the upper halves of floats.
struct PackedCertificateStep {
    enum Kind : std::uint32_t { leaf, both, either, either_one_way };

    float threshold;
    std::uint32_t slot : 30, kind : 2;
    std::uint16_t factor;
    std::uint16_t up, down;  ///< upper bounds on the second derivatives of g and of −g; infinite if unknown
    std::uint16_t unused = 0;

    bool operator==(const PackedCertificateStep&) const = default;
};

/// What a kernel runs. All members are plain pointers and numbers. Kernels are compiled for several instruction sets,
/// so they must not share inline functions of the standard library with code that may run on machines without those
/// sets.
struct Routine {
    const Step* steps;
    const std::uint32_t* data;  ///< for each step, the index of its first constant
    const float* constants;
    std::size_t count;  ///< of steps
    const OutputSlot* outputs;
    std::size_t output_count;
    /// Which lower bound s of the distance to a change of label is used where each component has its own value. If
    /// true, s is minus the component of the label; if false, the smallest of the other components, which is at least
    /// as large.
    bool uses_own_component = false;
    /// Whether the first component alone determines where rays may be. This is so if there are two phases, or if all
    /// phases other than the first are opaque, so that no ray is in them.
    bool first_component_decides = false;
    /// The number of steps at the beginning that compute the first component, which is all that a ray in its phase
    /// needs; 0 if no such number exists.
    std::size_t first_component_steps = 0;
    /// A certificate that the first component stays negative, used where its curvature is unknown; null if there is
    /// none.
    const PackedCertificateStep* certificate = nullptr;
    std::size_t certificate_steps = 0;
};

/// A routine that needs at most this many slots runs in the kernel's own registers; for any other, the caller provides
/// them.
inline constexpr std::uint32_t few_slots = 48;

/// A ray's visit to a cell, or to a whole object.
struct Visit {
    const Bounds* box;
    const LinearBound* bound;  ///< of the field in the box
    const Routine* routine;
    const TracedRay* ray;
    float* registers;  ///< the routine's slots; null if few_slots are enough
    /// The bounds of Curvature: first for a ray in the phase of the first output, then for one in any other phase.
    float curvature[2];
    float t_min, t_max;
    float resolution;
    float carried;  ///< the ray's phase; if negative, use the label at its start
    float rise;     ///< LeavingHint::rise, in [−1, 1], or no_leaving_hint
    /// Where an unfinished search resumes: a point in the ray's phase, as a distance from where the search began;
    /// otherwise 0.
    float t_begin = 0;

    /// The value of `rise` if there is no LeavingHint.
    static constexpr float no_leaving_hint = -2;
};

/// The first change of label of a visit, as a Crossing. If there is none, only the counters are set.
struct RayCrossing {
    double start;                     ///< the distance along the ray of the point where the search began
    float origin[3];                  ///< that point
    float t_from, t_to;               ///< distances from that point
    float from, to;                   ///< phases
    std::uint32_t batches, phantoms;  ///< see TraceCounters
    /// The search is unfinished: there is no change before t_from, which is in the phase `from`. See trace/creep.hpp.
    bool is_unfinished;
    float length;  ///< of the segment that is searched
};

/// The number of doubles per neuron in network_layer(), and the index of the first of those that are error bounds.
inline constexpr std::size_t network_lanes = 24, absolute_lane = 20;

/// The functions that are compiled once for each instruction set. Arrays of points have batch_size floats per
/// coordinate. Registers are the slots of a routine, batch_size floats each; slots 0 … 2 hold the point.
struct Kernel {
    /// Computes all outputs of a routine, one batch after another.
    void (*evaluate)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* out);
    /// Computes labels and lower bounds on the distance to an interface.
    void (*sample)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* label,
                   float* distance);
    /// Does the same at the points origin + t·direction of a ray.
    void (*sample_ray)(const Routine&, const float* origin, const float* direction, const float* t, float* registers,
                       float* label, float* distance);
    /// Whether the label changes along the part of the ray within the box, and where it does so first: see visit.inl.
    bool (*visit)(const Visit&, RayCrossing&);
    /// Computes a linear layer of a network with several numbers per neuron: see network_layer.inl.
    void (*network_layer)(const float* weights, const float* bias, std::size_t inputs, std::size_t outputs,
                          const double* in, double* out);
};

extern const Kernel kernel_baseline;
#ifdef PHASETREE_X86
extern const Kernel kernel_sse4;
extern const Kernel kernel_avx2;
extern const Kernel kernel_avx512;
#endif

}  // namespace phasetree::kernel
