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
    /// Call this often, with a number that changes whenever there was work. At most every two seconds, after new work,
    /// this returns free memory to the system if the process has grown by more than `slack` since it was smallest.
    /// Smaller amounts stay, because fetching returned memory again takes time.
    void poll(std::uint64_t work);

    static constexpr std::size_t slack = std::size_t{64} << 20;
    static constexpr std::chrono::seconds interval{2};

  private:
    std::optional<std::uint64_t> returned_for_;  // the work after which memory was last returned
    std::optional<std::size_t> least_;           // bytes of the process
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace phasetree::tracer::view
