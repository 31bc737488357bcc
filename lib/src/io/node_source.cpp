#include "io/node_source.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <time.h>

namespace phasetree::io {

std::optional<std::string> state_of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    struct timespec now {};
    if (::clock_gettime(CLOCK_REALTIME, &now) != 0) return std::nullopt;
    constexpr std::int64_t second = 1'000'000'000;
    const auto nanoseconds = [](const struct timespec& time) {
        return std::int64_t{time.tv_sec} * second + std::int64_t{time.tv_nsec};
    };
    if (nanoseconds(now) - nanoseconds(status.st_mtim) < second) return std::nullopt;
    return fmt::format("{} {} {} {}", status.st_dev, status.st_ino, status.st_size, nanoseconds(status.st_mtim));
}

}  // namespace phasetree::io
