#include "phasetree_support/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "phasetree_support/folder.hpp"

namespace phasetree::support {

namespace {

namespace fs = std::filesystem;

/// The directory that contains a file.
fs::path folder_of(const fs::path& target) {
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// Follows symbolic links, including links to links, to a path that is not a link. No file need exist there.
fs::path followed(const fs::path& path) {
    constexpr int most_links = 40;  // Linux's own limit
    fs::path target = path;
    std::error_code error;
    for (int i = 0; fs::is_symlink(fs::symlink_status(target, error)); ++i) {
        if (i == most_links) throw FileError(ELOOP, "the symbolic link points to itself");
        const fs::path next = fs::read_symlink(target, error);
        if (error) throw FileError(error.value(), fmt::format("the symbolic link is broken: {}", error.message()));
        target = target.parent_path() / next;
    }
    return target;
}

/// The path of the file after following links. Throws all errors that can be detected without creating anything.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path target = followed(path);
    const fs::path folder = folder_of(target);
    const fs::file_status folder_status = fs::status(folder, error);
    if (folder_status.type() == fs::file_type::not_found)
        throw FileError(ENOENT, fmt::format("no such directory: \"{}\"", folder.string()));
    if (folder_status.type() == fs::file_type::none) throw FileError(error.value(), error.message());
    if (folder_status.type() != fs::file_type::directory)
        throw FileError(ENOTDIR, fmt::format("\"{}\" is not a directory", folder.string()));
    const fs::file_status status = fs::status(target, error);
    if (status.type() == fs::file_type::directory) throw FileError(EISDIR, "it is a directory");
    if (fs::exists(status)) {
        if (status.type() != fs::file_type::regular) throw FileError(EINVAL, "it is not a regular file");
        // Replacing a file by renaming ignores its permissions. But a write-protected file should not be replaced.
        if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) throw FileError(errno);
    } else if (status.type() == fs::file_type::none) {
        throw FileError(error.value(), error.message());
    }
    return target;
}

constexpr std::string_view temporary_end = ".tmp";

/// The beginning of a file's temporary names. File systems allow 255 bytes; the rest is reserved for the numbers.
std::string temporary_start(const fs::path& target) {
    return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

/// A temporary name in the same directory; different for each file that this process writes at the same time.
fs::path name_beside(const fs::path& target) {
    static std::atomic<unsigned> written{0};
    fs::path beside = target;
    beside.replace_filename(fmt::format("{}{}.{}{}", temporary_start(target), ::getpid(), written++, temporary_end));
    return beside;
}

bool is_temporary_of(const fs::path& target, const std::string& name) {
    const std::string start = temporary_start(target);
    if (name.size() <= start.size() + temporary_end.size() || !name.starts_with(start) ||
        !name.ends_with(temporary_end))
        return false;
    const auto numbers = std::string_view(name).substr(start.size(), name.size() - start.size() - temporary_end.size());
    return numbers.find_first_not_of("0123456789.") == std::string_view::npos && std::ranges::count(numbers, '.') == 1;
}

/// Removes temporary files of processes that were killed. A file that is still being written is locked by its writer,
/// on whatever machine. On file systems without locks, nothing is removed.
void remove_abandoned(const fs::path& target) {
    // If the folder cannot be read, opening files in it reports the error.
    (void)each_entry(folder_of(target), [&](const fs::path& path) {
        if (!is_temporary_of(target, path.filename().string())) return true;
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (file < 0) return true;
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
        ::close(file);
        return true;
    });
}

/// Closes a descriptor when it goes out of scope, unless it is −1.
class Descriptor {
  public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

  private:
    int descriptor_;
};

/// Whether an open file still has this name.
bool has_name(int file, const fs::path& name) {
    struct stat of_file {};
    struct stat of_name {};
    return ::fstat(file, &of_file) == 0 && ::stat(name.c_str(), &of_name) == 0 && of_file.st_ino == of_name.st_ino &&
           of_file.st_dev == of_name.st_dev;
}

}  // namespace

WholeFile::WholeFile(const fs::path& path) : target_(resolved(path)), temporary_(name_beside(target_)) {
    remove_abandoned(target_);
    ::unlink(temporary_.c_str());  // of a process that was killed and had the same id, where there are no locks
    open();
    // Until it is locked, the new file looks abandoned to another process that writes the same file, which may remove
    // it.
    while (::flock(descriptor_, LOCK_EX) == 0 && !has_name(descriptor_, temporary_)) {
        ::close(std::exchange(descriptor_, -1));
        open();
    }
}

void WholeFile::open() {
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) return;
    const int code = errno;
    throw FileError(code, fmt::format("cannot create a file in the directory \"{}\": {}", folder_of(target_).string(),
                                      std::generic_category().message(code)));
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

void WholeFile::close() {
    // Network file systems report a full disk only here.
    if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) throw FileError(errno);
}

void WholeFile::finish() {
    // Keep the file locked until it has its final name.
    const Descriptor lock(descriptor_ >= 0 ? ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0) : -1);
    close();
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) throw FileError(error.value());
    is_renamed_ = true;
}

void WholeFile::finish_on_disk() {
    if (::fsync(descriptor_) != 0) throw FileError(errno);
    finish();
    // The name is stored in the folder, so the folder must be on the disk, too.
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) throw FileError(errno);
    const int failure = ::fsync(folder) == 0 ? 0 : errno;
    ::close(folder);
    if (failure != 0 && failure != EINVAL) throw FileError(failure);  // EINVAL: this file system has no such call
}

}  // namespace phasetree::support
