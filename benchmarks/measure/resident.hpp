#pragma once

#include <unistd.h>

#include <fstream>

namespace phasetree::bench {

// The memory of this process that is in the machine's, in 10⁶ bytes.
inline double resident_megabytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0, resident = 0;
    statm >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace phasetree::bench
