#define PHASETREE_RUN run_precisely_avx2
#include "kernel/precise_kernel.inl"
