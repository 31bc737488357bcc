#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/linear_bound.hpp"
#include "phasetree/model/phase.hpp"
#include "phasetree/model/ray.hpp"

namespace phasetree::kernel {

/// The largest number of steps of a sign certificate.
inline constexpr std::size_t most_certificate_steps = 32;

/// An instruction that is ready to run. Slots count batches among the registers; a point takes three. The offsets of
/// the constants are kept apart (Routine::data), so that routines which differ only in constants share their steps.
struct Step {
    std::uint32_t op;  ///< an Op
    std::uint32_t to;  ///< the slot of the result
    std::uint32_t a;   ///< the slots of the operands
    std::uint32_t b;

    bool operator==(const Step&) const = default;
};

/// Where a component is after the steps have run: it is sign (1 or −1) times the slot's value.
struct OutputSlot {
    std::uint32_t slot;
    float phase;
    float sign;

    bool operator==(const OutputSlot&) const = default;
};

/// A step of a certificate, in postfix order, that a field keeps its sign between samples: see sign_certificate.inl. A
/// leaf is the field
///     g = factor · (the slot's value − threshold),
/// which is 1-Lipschitz. Numbers of 16 bits are the upper halves of floats.
struct PackedCertificateStep {
    enum Kind : std::uint32_t { leaf, both, either, either_one_way };

    float threshold;
    std::uint32_t slot : 30, kind : 2;
    std::uint16_t factor;
    std::uint16_t up, down;  ///< bounds of the second derivatives of g and of −g; infinite if unknown
    std::uint16_t unused = 0;

    bool operator==(const PackedCertificateStep&) const = default;
};

/// What a kernel runs. It has plain pointers, because kernels are compiled for several instruction sets and must not
/// share inline functions of the standard library with other code, which may run on machines without these sets.
struct Routine {
    const Step* steps;
    const std::uint32_t* data;  ///< for each step, the index of its first constant
    const float* constants;
    std::size_t count;  ///< of steps
    const OutputSlot* outputs;
    std::size_t output_count;
    /// Which lower bound s of the distance to a change of label is used where each component has a value of its own:
    /// minus the component of the label (true), or the smallest of the others (false), which is no smaller.
    bool is_by_own = false;
    /// Whether the first component alone tells where rays may be: there are two phases, or no ray is in any of the
    /// other phases, because these are opaque.
    bool is_by_first = false;
    /// The first `leading` steps compute the first component, which is enough for a ray that is in its phase; 0 if
    /// there is no such number.
    std::size_t leading = 0;
    /// A certificate that the first component stays negative, for where its curvature is not known; null if there is
    /// none.
    const PackedCertificateStep* certificate = nullptr;
    std::size_t certificate_steps = 0;
};

/// A routine that needs no more slots than this runs in registers of the kernel's own; others must bring theirs.
inline constexpr std::uint32_t few_slots = 48;

/// A ray's visit to a cell, or to a whole object.
struct Visit {
    const Bounds* box;
    const LinearBound* bound;  ///< of the field in the box
    const Routine* routine;
    const TracedRay* ray;
    float* registers;  ///< the routine's slots; null if they are at most few_slots
    /// The bounds of Curvature: in the phase of the first output, and in the others.
    float curvature[2];
    float t_min, t_max;
    float resolution;
    float carried;  ///< the phase that the ray is in; negative: the label at its start
    float rise;     ///< LeavingHint::rise, in [−1, 1], or no_leaving_hint
    /// Where an unfinished search goes on: a point in the ray's phase, as a distance from where the search began; else
    /// 0.
    float t_begin = 0;

    /// A value of `rise`, which no LeavingHint has.
    static constexpr float no_leaving_hint = -2;
};

/// The first change of label of a visit, as a Crossing. If there is none, only the counters are set.
struct RayCrossing {
    double start;                     ///< the distance along the ray of the point where the search began
    float origin[3];                  ///< that point
    float t_in, t_out;                ///< distances from that point
    float from, to;                   ///< phases
    std::uint32_t batches, phantoms;  ///< see TraceCounters
    /// The search was left unfinished: there is no change up to t_in, which is in the phase `from`. See
    /// trace/creep.hpp.
    bool is_unfinished;
    float length;  ///< of the piece of the ray that is searched
};

/// The number of doubles of a neuron in network_layer(), and the index of the first of those that are error bounds.
inline constexpr std::size_t network_lanes = 24, absolute_lane = 20;

/// The functions that are compiled once for each instruction set. Arrays of points have batch_size floats for each
/// coordinate. Registers are the slots of a routine, batch_size floats each; slots 0 … 2 hold the point.
struct Kernel {
    /// All outputs of a routine, one batch after another.
    void (*evaluate)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* out);
    /// The labels and interface distances.
    void (*sample)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* label,
                   float* distance);
    /// The same at the points origin + t·direction of a ray.
    void (*sample_ray)(const Routine&, const float* origin, const float* direction, const float* t, float* registers,
                       float* label, float* distance);
    /// Whether the label changes where the ray is in the box, and where it first does: see visit.inl.
    bool (*visit)(const Visit&, RayCrossing&);
    /// A linear layer of a network whose neurons have several numbers each: see network_layer.inl.
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
