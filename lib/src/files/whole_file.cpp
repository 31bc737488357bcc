#include "files/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <utility>

namespace phasetree::files {

namespace {

namespace fs = std::filesystem;

/// Where the file really goes, links followed.
fs::path target_of(const fs::path& path) {
    std::error_code error;
    fs::path target = path;
    if (fs::is_symlink(fs::symlink_status(path, error))) {
        target = fs::weakly_canonical(path, error);
        if (error) throw FileError(error.value());
    }
    const fs::file_status status = fs::status(target, error);
    if (status.type() == fs::file_type::none) throw FileError(error.value());
    if (!fs::exists(status)) return target;
    if (status.type() == fs::file_type::directory) throw FileError(EISDIR);
    if (status.type() != fs::file_type::regular) throw FileError(EINVAL, "it is no regular file");
    // Renaming over a file does not ask for its permissions, but who protects a file means it.
    if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) throw FileError(errno);
    return target;
}

/// Another one for each file that this process writes at once.
fs::path name_beside(const fs::path& target) {
    static std::atomic<unsigned> written{0};
    // File systems allow 255 bytes; the rest is for the numbers.
    const std::string name = target.filename().string().substr(0, 200);
    fs::path beside = target;
    beside.replace_filename(fmt::format(".{}.{}.{}.tmp", name, ::getpid(), written++));
    return beside;
}

}  // namespace

WholeFile::WholeFile(const fs::path& path) : target_(target_of(path)), temporary_(name_beside(target_)) {
    ::unlink(temporary_.c_str());  // of a process that was killed and had the same id
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw FileError(errno);
}

WholeFile::~WholeFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!is_renamed_) ::unlink(temporary_.c_str());
}

void WholeFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw FileError(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void WholeFile::finish() {
    // Network file systems report a full disk only here.
    if (::close(std::exchange(descriptor_, -1)) != 0) throw FileError(errno);
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) throw FileError(error.value());
    is_renamed_ = true;
}

}  // namespace phasetree::files
