// Faults on purpose: memory that runs out at the n-th allocation, and files that cannot be written.
//
// Only allocations of the project's own code fail, those it makes through the standard library among them. Embree, TBB,
// OpenImageIO and OpenColorIO are others' code: Embree and TBB end the process where a lock or a task cannot be
// allocated, OpenImageIO's and OpenColorIO's static registries do so while the program starts, and nothing of that can
// be mended here.
#pragma once

#include <cstddef>

namespace phasetree::tests::faults {

// How allocations fail: the n-th from now on, from 1, and with `for_good` all that follow. Of every thread.
void fail_allocation(std::size_t n, bool for_good);
// Ends that; how many allocations of the project's own code there were since fail_allocation().
std::size_t stop_failing_allocations();

// What becomes of write() to files (not to the standard streams), close(), rename() and open() for writing.
struct WriteFaults {
    std::size_t failing = 0;   // the call that fails, from 1; 0: none
    bool for_good = false;     // and all that follow
    int error = 0;             // errno
    std::size_t shortest = 0;  // a write() takes no more bytes than this; 0: any number
};
void set_write_faults(const WriteFaults&);
// Ends that; such calls since set_write_faults().
std::size_t stop_write_faults();

}  // namespace phasetree::tests::faults
