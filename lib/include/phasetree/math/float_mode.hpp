#pragma once

#if defined(__SSE__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace phasetree {

/// While it lives, this thread takes subnormal numbers for zero, in operands and results: they cost time and carry no
/// information in a distance. It must stand at the start of every task that traces, so that all threads compute alike.
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
