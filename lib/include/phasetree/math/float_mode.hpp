#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace phasetree {

/// While an object of this class lives, its thread takes subnormal numbers for zero, as operands and as results,
/// because they cost time and carry no information in a distance. Every task that traces rays must hold one, so that
/// all threads compute alike.
///
/// x86-64 and arm64 differ in one case: a result that is subnormal before it is rounded, and the least normal number
/// afterwards. Only arm64 flushes it to zero.
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
    FlushSubnormals() {}  // not defaulted, or every object would be an unused variable
#endif
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;
};

}  // namespace phasetree
