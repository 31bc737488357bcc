#define PHASETREE_RUN run_precisely_sse4
#include "kernel/precise_kernel.inl"
