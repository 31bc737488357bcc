#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace phasetree {

/// Thrown while a node is created, if PreparationWatch::Callbacks::cancelled returns true.
class PreparationCancelled : public std::runtime_error {
  public:
    PreparationCancelled() : std::runtime_error("preparing a node was cancelled") {}
};

/// As long as it exists, watches the nodes that this thread creates or reads from a scene. Some of them derive data
/// from their parameters and files, which takes seconds for a mesh of millions of triangles. If there are several
/// watches, the newest one counts.
class PreparationWatch {
  public:
    struct Callbacks {
        /// Polled by any thread; return true to cancel with PreparationCancelled. May be empty.
        std::function<bool()> cancelled{};
        /// Receives the name of a node and the completed share of its preparation, which ends with 1 unless it fails.
        /// Called by the thread that creates the node. May be empty.
        std::function<void(std::string_view node, float share)> progress{};
    };
    explicit PreparationWatch(Callbacks);
    ~PreparationWatch();
    PreparationWatch(const PreparationWatch&) = delete;
    PreparationWatch& operator=(const PreparationWatch&) = delete;

    /// The callbacks of this thread's watch; null if there is none.
    static const Callbacks* current();

  private:
    Callbacks callbacks_;
    const PreparationWatch* around_;  ///< this thread's previous watch
};

}  // namespace phasetree
