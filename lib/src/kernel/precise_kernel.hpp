#pragma once

#include <cstddef>

#include "kernel/kernel.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::kernel {

/// Runs a routine in double precision at eight points. The registers are the routine's slots, eight doubles each,
/// aligned to 64 bytes; slots 0 … 2 hold the points. Every lane gets the same bits as a run with Precise<0>.
using RunPrecisely = void (*)(const Routine&, double* registers);

/// Whether a RunPrecisely can run all steps of a routine. It cannot run primitives with data. The caller must also
/// exclude programs that search in floats.
bool can_run_precisely(const Routine&);

/// The function for the instruction set of a kernel.
RunPrecisely run_precisely_for(const Kernel&);

void run_precisely_baseline(const Routine&, double* registers);
#ifdef PHASETREE_X86
void run_precisely_sse4(const Routine&, double* registers);
void run_precisely_avx2(const Routine&, double* registers);
void run_precisely_avx512(const Routine&, double* registers);
#endif

// Functions of the standard library as Precise uses them. They are compiled once, without the flags of any instruction
// set.
double precise_sine(double);
double precise_cosine(double);
double precise_exponential(double);
double precise_angle(double x, double y);

}  // namespace phasetree::kernel
