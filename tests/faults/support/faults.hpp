// Injects faults: memory that runs out at the n-th allocation, and files that cannot be written.
//
// Only allocations by the project's own code fail, including those it makes through the standard library. Embree and
// TBB end the process if a lock or a task cannot be allocated, and so do the static registries of OpenImageIO and
// OpenColorIO while the program starts. These cannot be fixed here.
#pragma once

#include <cstddef>

namespace phasetree::tests::faults {

// Makes the n-th allocation from now on fail, counted from 1 over all threads; with `for_good`, all later ones, too.
void fail_allocation(std::size_t n, bool for_good);
// Ends this, and returns the number of allocations by the project's own code since fail_allocation().
std::size_t stop_failing_allocations();

// How write() to files (not to the standard streams), close(), rename() and open() for writing fail.
struct WriteFaults {
    std::size_t failing = 0;   // the call that fails, from 1; 0: none
    bool for_good = false;     // and all that follow
    int error = 0;             // errno
    std::size_t shortest = 0;  // a write() takes no more bytes than this; 0: any number
};
void set_write_faults(const WriteFaults&);
// Ends this, and returns the number of such calls since set_write_faults().
std::size_t stop_write_faults();

}  // namespace phasetree::tests::faults
