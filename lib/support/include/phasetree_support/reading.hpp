// Progress of reading large files. Readers report it, and code that displays it listens. Neither knows the other,
// because a dozen functions lie between them that need not know about progress.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

namespace phasetree::support {

/// While it exists, receives the progress of all reading on its thread. If there are several, only the newest receives
/// it.
class ReadingListener {
  public:
    /// `hear` is called with the number of bytes that have been read and parsed since the last call.
    explicit ReadingListener(std::function<void(std::uint64_t)> hear)
        : hear_(std::move(hear)), before_(std::exchange(newest(), this)) {}
    ~ReadingListener() { newest() = before_; }
    ReadingListener(const ReadingListener&) = delete;
    ReadingListener& operator=(const ReadingListener&) = delete;

    /// Notifies the thread's listener, if there is one. Readers call it about once per megabyte, not for every byte.
    static void tell(std::uint64_t bytes) {
        if (newest() != nullptr) newest()->hear_(bytes);
    }

  private:
    // The listener of this thread; null if there is none.
    static ReadingListener*& newest() {
        thread_local ReadingListener* listener = nullptr;
        return listener;
    }

    std::function<void(std::uint64_t)> hear_;
    ReadingListener* before_;
};

/// Reports progress through a file or a text, from the position reached, once per megabyte.
class ReadingPlace {
  public:
    static constexpr std::uint64_t step = std::uint64_t{1} << 20;

    void reached(std::uint64_t at) {
        if (at < told_ + step) return;
        finished(at);
    }
    void finished(std::uint64_t at) {
        ReadingListener::tell(at - told_);
        told_ = at;
    }

  private:
    std::uint64_t told_ = 0;
};

}  // namespace phasetree::support
