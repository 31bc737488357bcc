#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace phasetree {

/// Makes its thread treat subnormal numbers as zero, as operands and as results, for the lifetime of the object.
/// Subnormals are slow, and carry no information in a distance. Every task that traces rays must hold one, so that all
/// threads compute the same results.
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
