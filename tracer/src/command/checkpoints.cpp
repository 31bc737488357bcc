#include "command/checkpoints.hpp"

#include <new>

#include "command/streams.hpp"
#include "film_file/write.hpp"
#include "output/interrupt.hpp"

namespace phasetree::tracer {

namespace {

// Longest delay before SIGUSR1 is handled.
constexpr std::chrono::milliseconds patience{50};

}  // namespace

Checkpoints::Checkpoints(std::filesystem::path file, double interval_seconds, const FilmFileHeader& header,
                         const Film& film)
    : file_(std::move(file)), interval_(interval_seconds), header_(header), film_(film) {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Checkpoints::~Checkpoints() {
    thread_.request_stop();
}

void Checkpoints::run(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    auto last = Clock::now();
    while (!stop.stop_requested()) {
        {
            std::unique_lock lock(waiting_);
            end_.wait_for(lock, stop, patience, [] { return false; });
        }
        const bool is_due = Clock::now() - last >= interval_, is_asked = take_checkpoint_request();
        if (stop.stop_requested() || (!is_due && !is_asked)) continue;
        try {
            write_film(file_, header_, film_);
        } catch (const std::bad_alloc&) {
            say("phasetree: out of memory for a checkpoint; rendering continues\n");
        } catch (const std::exception& e) {
            say("phasetree: {}; rendering continues\n", e.what());
        }
        last = Clock::now();
    }
}

}  // namespace phasetree::tracer
