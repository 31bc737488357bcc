#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace phasetree {

/// Makes its thread treat subnormal numbers as zero, as operands and as results, for the lifetime of the object.
/// Subnormals are slow, and carry no information in a distance. Every task that traces rays must hold one, so that all
/// threads compute the same results.
///
/// x86-64 and arm64 differ in one case: if the exact result is below the smallest normal number but rounds to it,
/// x86-64 returns that number, and arm64 returns zero.
class FlushSubnormals {
  public:
#if defined(__SSE__) || defined(_M_X64)
    FlushSubnormals() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | 0x8040u);
    }
    ~FlushSubnormals() {
        _mm_setcsr(before_);
    }

  private:
    unsigned before_;

  public:
#elif defined(__aarch64__)
    FlushSubnormals() {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        set(before_ | std::uint64_t{1} << 24);  // FZ
    }
    ~FlushSubnormals() {
        set(before_);
    }

  private:
    static void set(std::uint64_t mode) {
        asm volatile("msr fpcr, %0" : : "r"(mode) : "memory");
    }
    std::uint64_t before_;

  public:
#else
    FlushSubnormals() {}  // not defaulted, because compilers would report every object as unused
#endif
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;
};

}  // namespace phasetree
