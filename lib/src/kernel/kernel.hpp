#pragma once

#include <cstddef>
#include <cstdint>

#include "phasetree/program/evaluator.hpp"

namespace phasetree {

/// What a kernel runs: plain pointers, because kernels are compiled for several instruction sets and must not share
/// inline functions of the standard library with the rest.
struct Routine {
    const Evaluator::Step* steps;
    std::size_t count;
    const float* constants;
    const std::uint32_t* output_slot;
    const float* output_phase;
    std::size_t outputs;
};

/// A kernel: the same functions for one instruction set. Slot 0 … 2 is the input point.
struct Kernel {
    void (*evaluate)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* out);
    void (*sample)(const Routine&, const float* x, const float* y, const float* z, float* registers, float* label,
                   float* distance);
    void (*sample_ray)(const Routine&, const float* origin, const float* direction, const float* t, float* registers,
                       float* label, float* distance);
};

extern const Kernel kernel_baseline;
#ifdef PHASETREE_X86
extern const Kernel kernel_sse4;
extern const Kernel kernel_avx2;
extern const Kernel kernel_avx512;
#endif

}  // namespace phasetree
