#define PHASETREE_KERNEL kernel_avx512
#include "kernel/kernel.inl"
