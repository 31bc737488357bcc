#include "io/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>
#include <vector>

#include "phasetree/io/suggest.hpp"
#include "phasetree_support/folder.hpp"

namespace phasetree::io {

namespace {

class OpenFile {
  public:
    // O_NONBLOCK: otherwise, opening a pipe without a writer would wait forever.
    explicit OpenFile(const char* path) : descriptor_(::open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

// A file in the same folder with a name similar to the missing one.
std::optional<std::string> neighbour(const std::filesystem::path& missing) {
    constexpr std::size_t max_looked_at = 1000;
    const std::filesystem::path folder = missing.has_parent_path() ? missing.parent_path() : ".";
    std::vector<std::string> names;
    (void)support::each_entry(folder, [&](const std::filesystem::path& path) {
        names.push_back(path.filename().string());
        return names.size() < max_looked_at;
    });
    std::sort(names.begin(), names.end());  // the order of a folder's entries is arbitrary
    const auto name = closest(missing.filename().string(), names);
    if (!name) return std::nullopt;
    return (missing.parent_path() / *name).string();
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::size_t max_bytes) {
    const std::string name = path.string();
    if (name.empty()) throw SceneError("(no name)", "the name of a file is empty");
    const auto fail = [&](int code) -> SceneError {
        if (code == ENOENT || code == ENOTDIR) return {name, "no such file", neighbour(path)};
        if (code == EACCES || code == EPERM) return {name, "no permission to read the file"};
        return {name, "cannot be read: " + std::generic_category().message(code)};
    };
    if (name.find('\0') != std::string::npos) throw fail(ENOENT);

    const auto too_large = [&] { return SceneError(name, fmt::format("is larger than {} MiB", max_bytes >> 20)); };

    // Check before opening, too: opening a device can have side effects.
    struct stat status {};
    if (::stat(name.c_str(), &status) != 0) throw fail(errno);
    const auto check = [&] {
        if (S_ISDIR(status.st_mode)) throw SceneError(name, "is a directory, not a file");
        if (!S_ISREG(status.st_mode)) throw SceneError(name, "is not a regular file but a pipe, a socket or a device");
        if (status.st_size > 0 && static_cast<std::size_t>(status.st_size) > max_bytes) throw too_large();
    };
    check();
    const OpenFile file(name.c_str());
    if (file.descriptor() < 0 || ::fstat(file.descriptor(), &status) != 0) throw fail(errno);
    check();

    // The size is a hint: the file may grow meanwhile, and files in /proc have size 0.
    std::string content;
    std::size_t length = 0;
    content.resize(static_cast<std::size_t>(status.st_size) + 1);
    while (true) {
        const ssize_t got = ::read(file.descriptor(), content.data() + length, content.size() - length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw fail(errno);
        if (got == 0) break;
        length += static_cast<std::size_t>(got);
        if (length > max_bytes) throw too_large();
        if (length == content.size()) content.resize(2 * length);
    }
    content.resize(length);
    return content;
}

}  // namespace phasetree::io
