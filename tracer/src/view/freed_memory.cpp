#include "view/freed_memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace phasetree::tracer::view {

namespace {

// The resident memory of the process in bytes; 0 if the system does not report it.
std::size_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0, resident = 0;
    statm >> all >> resident;
    return statm ? resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void return_free_memory() {
#if defined(__GLIBC__)
    ::malloc_trim(0);
#endif
}

}  // namespace

void FreedMemory::poll(std::uint64_t work) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_ || returned_for_ == work) return;
    next_ = now + interval;
    const std::size_t resident = resident_bytes();
    least_ = std::min(least_.value_or(resident), resident);
    if (resident - *least_ > slack) return_free_memory();
    returned_for_ = work;
}

}  // namespace phasetree::tracer::view
