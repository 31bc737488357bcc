// The system's calls by which files are written, for the whole process: the program's own definitions come before the
// C library's.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>

#include "faults/support/faults.hpp"

namespace phasetree::tests::faults {

namespace {

// The calls are plain functions: what they know is static.
WriteFaults faults;
std::atomic<std::size_t> calls{0};
std::atomic<bool> writes_fail{false};

bool fails() {
    if (!writes_fail) return false;
    const std::size_t n = ++calls;
    if (faults.failing == 0 || n < faults.failing || (n > faults.failing && !faults.for_good)) return false;
    errno = faults.error;
    return true;
}

}  // namespace

void set_write_faults(const WriteFaults& to) {
    faults = to;
    calls = 0;
    writes_fail = true;
}
std::size_t stop_write_faults() {
    writes_fail = false;
    return calls;
}

}  // namespace phasetree::tests::faults

using namespace phasetree::tests::faults;

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
    if (file > STDERR_FILENO && writes_fail) {
        if (fails()) return -1;
        if (faults.shortest > 0) count = std::min(count, faults.shortest);
    }
    return ::syscall(SYS_write, file, bytes, count);
}

int open(const char* path, int flags, ...) {
    mode_t mode = 0;
    if ((flags & (O_CREAT | O_TMPFILE)) != 0) {
        va_list rest;
        va_start(rest, flags);
        mode = va_arg(rest, mode_t);
        va_end(rest);
    }
    if ((flags & O_ACCMODE) != O_RDONLY && fails()) return -1;
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int rename(const char* from, const char* to) {
    if (fails()) return -1;
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int fsync(int file) {
    if (fails()) return -1;
    return static_cast<int>(::syscall(SYS_fsync, file));
}

// EINTR leaves a file closed on Linux; so does every other error.
int close(int file) {
    const bool failed = file > STDERR_FILENO && fails();
    const int error = errno, result = static_cast<int>(::syscall(SYS_close, file));
    if (!failed) return result;
    errno = error;
    return -1;
}
}
