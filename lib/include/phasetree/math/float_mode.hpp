#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace phasetree {

/// While an object of this class lives, its thread takes subnormal numbers for zero, as operands and as results,
/// because they cost time and carry no information in a distance. Every task that traces rays must hold one, so that
/// all threads compute alike.
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
#else
    FlushSubnormals() = default;
#endif
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;
};

}  // namespace phasetree
