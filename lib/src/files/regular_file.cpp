#include "files/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace phasetree::files {

RegularFile::RegularFile(const std::filesystem::path& path) {
    struct stat status {};
    // Check before opening, too: opening a device can have side effects, and opening a pipe may block forever.
    if (::stat(path.c_str(), &status) != 0) throw FileError(errno);
    if (!S_ISREG(status.st_mode)) throw FileError(EINVAL, "it is not a regular file");
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) throw FileError(errno);
    const int error = ::fstat(descriptor_, &status) != 0 ? errno : S_ISREG(status.st_mode) ? 0 : EINVAL;
    if (error != 0) {
        ::close(descriptor_);
        throw FileError(error);
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

RegularFile::~RegularFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

bool RegularFile::read(void* to, std::size_t count) {
    auto* at = static_cast<char*>(to);
    while (count > 0) {
        const ssize_t got = ::read(descriptor_, at, count);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw FileError(errno);
        if (got == 0) return false;
        at += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace phasetree::files
