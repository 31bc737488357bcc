#define PHASETREE_KERNEL kernel_baseline
#include "kernel/kernel.inl"
