#define PHASETREE_KERNEL kernel_avx2
#include "kernel/kernel.inl"
