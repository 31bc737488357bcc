// The files that a scene was read from, and their state at that time, for detecting when one is saved.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace phasetree::tracer::studio {

class WatchedFiles {
  public:
    /// Adds a file. Call this before opening it, so that saving it during reading counts as a change. The file may be
    /// missing; then its creation is the change. Beyond `most` files, nothing is added.
    void add(const std::filesystem::path& file);

    /// The same files in their current state.
    WatchedFiles now() const;
    /// Whether both are the same files in the same state.
    bool operator==(const WatchedFiles&) const = default;

    static constexpr std::size_t most = 1024;

  private:
    /// Changes when a file is written in place, or replaced by another.
    struct Stamp {
        bool is_there = false;
        std::uint64_t inode = 0, size = 0;
        std::int64_t seconds = 0, nanoseconds = 0;

        static Stamp of(const std::filesystem::path& file);
        bool operator==(const Stamp&) const = default;
    };
    struct Entry {
        std::filesystem::path file;
        Stamp stamp;
        bool operator==(const Entry&) const = default;
    };

    std::vector<Entry> entries_;
};

}  // namespace phasetree::tracer::studio
