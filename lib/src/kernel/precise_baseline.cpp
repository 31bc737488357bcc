#define PHASETREE_RUN run_precisely_baseline
#include "kernel/precise_kernel.inl"
