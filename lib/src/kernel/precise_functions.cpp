// Scalar functions that all kernels in double precision share, and the choice of the instruction set.
#include <cmath>

#include "kernel/precise_kernel.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/fused.hpp"

namespace phasetree::kernel {

bool can_run_precisely(const Routine& routine) {
    constexpr auto first_data = static_cast<std::uint32_t>(Op::first_primitive) + Primitives::size;
    for (std::size_t i = 0; i < routine.count; ++i) {
        const std::uint32_t op = routine.steps[i].op;
        if ((op >= first_data && op < program::first_map) || op >= program::first_placed) return false;
    }
    return true;
}

RunPrecisely run_precisely_for(const Kernel& kernel) {
#ifdef PHASETREE_X86
    if (&kernel == &kernel_avx512) return run_precisely_avx512;
    if (&kernel == &kernel_avx2) return run_precisely_avx2;
    if (&kernel == &kernel_sse4) return run_precisely_sse4;
#endif
    (void)kernel;
    return run_precisely_baseline;
}

double precise_sine(double x) {
    return std::sin(x);
}
double precise_cosine(double x) {
    return std::cos(x);
}
double precise_exponential(double x) {
    return std::exp(x);
}
double precise_angle(double x, double y) {
    return x * x + y * y > 0 ? portable::atan2(y + 0.0, x) : 0.0;
}

}  // namespace phasetree::kernel
