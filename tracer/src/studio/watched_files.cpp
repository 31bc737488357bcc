#include "studio/watched_files.hpp"

#include <sys/stat.h>

#include <algorithm>

namespace phasetree::tracer::studio {

WatchedFiles::Stamp WatchedFiles::Stamp::of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return {};
    return {true, static_cast<std::uint64_t>(status.st_ino), static_cast<std::uint64_t>(status.st_size),
            static_cast<std::int64_t>(status.st_mtim.tv_sec), static_cast<std::int64_t>(status.st_mtim.tv_nsec)};
}

void WatchedFiles::add(const std::filesystem::path& file) {
    const bool is_known = std::ranges::any_of(entries_, [&](const Entry& entry) { return entry.file == file; });
    if (!is_known && entries_.size() < most) entries_.push_back({file, Stamp::of(file)});
}

WatchedFiles WatchedFiles::now() const {
    WatchedFiles result = *this;
    for (Entry& entry : result.entries_) entry.stamp = Stamp::of(entry.file);
    return result;
}

}  // namespace phasetree::tracer::studio
