#define PHASETREE_KERNEL kernel_sse4
#include "kernel/kernel.inl"
