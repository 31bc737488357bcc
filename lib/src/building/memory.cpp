// Determines how much memory is available for cells. Linux limits a group of processes, such as a container, through
// files (https://docs.kernel.org/admin-guide/cgroup-v2.html, memory.max; in version 1, memory.limit_in_bytes).
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "phasetree/building/options.hpp"

namespace phasetree {

namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

// The number in a file; no limit if the file is missing or contains no number ("max").
std::uint64_t limit_in(const std::filesystem::path& file) {
    std::uint64_t bytes = 0;
    std::ifstream in(file);
    return in >> bytes ? bytes : no_limit;
}

// The smallest limit of a group and all its ancestors. In a container, the mounted root is the container's own group,
// and the path may not exist there.
std::uint64_t limit_of_group(const std::filesystem::path& root, const std::string& path, const char* file) {
    std::uint64_t least = limit_in(root / file);
    std::filesystem::path group = root;
    for (const auto& name : std::filesystem::path(path).relative_path()) {
        group /= name;
        least = std::min(least, limit_in(group / file));
    }
    return least;
}

// A line of /proc/self/cgroup is "0::/path", or "4:memory:/path" in version 1.
std::uint64_t limit_of_groups() {
    std::uint64_t least = no_limit;
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
        if (controllers.empty())
            least = std::min(least, limit_of_group("/sys/fs/cgroup", path, "memory.max"));
        else if (controllers.find("memory") != std::string::npos)
            least = std::min(least, limit_of_group("/sys/fs/cgroup/memory", path, "memory.limit_in_bytes"));
    }
    return least;
}

std::uint64_t physical_memory() {
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) : no_limit;
}

std::uint64_t limit_of_process() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : no_limit;
}

}  // namespace

std::size_t default_cell_bytes() {
    constexpr std::uint64_t most = std::uint64_t{2} << 30;
    return static_cast<std::size_t>(
        std::min(most, std::min({physical_memory(), limit_of_groups(), limit_of_process()}) / 4));
}

}  // namespace phasetree
