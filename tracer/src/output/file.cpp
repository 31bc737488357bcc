#include "output/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "output/error.hpp"

namespace phasetree::tracer {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    throw OutputError(fmt::format("cannot write \"{}\": {}", path.string(), reason));
}

std::string message(int error) {
    return std::generic_category().message(error);
}

/// A file that vanishes unless it is renamed to its final name.
class Temporary {
  public:
    Temporary(const fs::path& target, const fs::path& named) : named_(named), path_(name_beside(target)) {
        ::unlink(path_.c_str());  // of a process that was killed and had the same id
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            const int error = errno;
            const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
            fail(named_,
                 fmt::format("no file can be created in the directory \"{}\": {}", folder.string(), message(error)));
        }
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!renamed_) ::unlink(path_.c_str());
    }

    void write(std::span<const unsigned char> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(named_, message(errno));
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        // Network file systems report a full disk only here.
        if (::close(std::exchange(descriptor_, -1)) != 0) fail(named_, message(errno));
    }

    void rename_to(const fs::path& target) {
        std::error_code error;
        fs::rename(path_, target, error);
        if (error) fail(named_, error.message());
        renamed_ = true;
    }

  private:
    static fs::path name_beside(const fs::path& target) {
        // File systems allow 255 bytes; the rest is for the process id and the extension.
        const std::string name = target.filename().string().substr(0, 200);
        fs::path beside = target;
        beside.replace_filename(fmt::format(".{}.{}.tmp{}", name, ::getpid(), target.extension().string()));
        return beside;
    }

    fs::path named_;  // as the user wrote it
    fs::path path_;
    int descriptor_ = -1;
    bool renamed_ = false;
};

/// Where a symbolic link leads, and that one, and so on, whether there is a file or not.
fs::path followed(const fs::path& path) {
    constexpr int most_links = 40;  // Linux's own limit
    fs::path target = path;
    std::error_code error;
    for (int i = 0; fs::is_symlink(fs::symlink_status(target, error)); ++i) {
        if (i == most_links) fail(path, "the symbolic link leads nowhere: in a circle");
        const fs::path next = fs::read_symlink(target, error);
        if (error) fail(path, fmt::format("the symbolic link leads nowhere: {}", error.message()));
        target = target.parent_path() / next;
    }
    return target;
}

/// Where the file really goes, links followed; fails with what can be said without creating anything.
fs::path resolve(const fs::path& path) {
    std::error_code error;
    const fs::path target = followed(path);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const fs::file_status folder_status = fs::status(folder, error);
    if (folder_status.type() == fs::file_type::not_found) {
        fail(path, fmt::format("there is no directory \"{}\"", folder.string()));
    }
    if (folder_status.type() == fs::file_type::none) fail(path, error.message());
    if (folder_status.type() != fs::file_type::directory) {
        fail(path, fmt::format("\"{}\" is not a directory", folder.string()));
    }
    const fs::file_status status = fs::status(target, error);
    if (status.type() == fs::file_type::directory) fail(path, "it is a directory");
    if (fs::exists(status)) {
        if (status.type() != fs::file_type::regular) fail(path, "it is not a regular file");
        // Renaming over a file does not ask for its permissions, but who protects a file means it.
        if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(path, message(errno));
    } else if (status.type() == fs::file_type::none) {
        fail(path, error.message());
    }
    return target;
}

}  // namespace

void write_file(std::span<const unsigned char> bytes, const fs::path& path) {
    const fs::path target = resolve(path);
    Temporary file(target, path);
    file.write(bytes);
    file.rename_to(target);
}

void check_file_writable(const fs::path& path) {
    Temporary(resolve(path), path).write({});
}

}  // namespace phasetree::tracer
