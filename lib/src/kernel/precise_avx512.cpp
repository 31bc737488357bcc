#define PHASETREE_RUN run_precisely_avx512
#include "kernel/precise_kernel.inl"
