// Returns freed memory to the system.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace phasetree::tracer::view {

/// The C library keeps freed memory for the thread that allocated it. In a server that reads and builds a different
/// scene after each edit, every thread would keep as much as its largest scene needed. Use one object per process.
class FreedMemory {
  public:
    /// Call this often, with a number that changes whenever there was work. Every two seconds, if there was any, and
    /// the process is larger than it was at its smallest by more than `slack`, this returns what is free. Smaller
    /// amounts stay, because memory that is returned has to be fetched again.
    void poll(std::uint64_t work);

    static constexpr std::size_t slack = std::size_t{64} << 20;
    static constexpr std::chrono::seconds interval{2};

  private:
    std::optional<std::uint64_t> returned_for_;  // the work after which memory was last returned
    std::optional<std::size_t> least_;           // bytes of the process
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace phasetree::tracer::view
