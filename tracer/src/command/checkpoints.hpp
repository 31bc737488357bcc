// Checkpoints: the film of an unfinished render, saved to a file at intervals.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "film/film.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

// During its lifetime, writes the film to the file at intervals, and when SIGUSR1 arrives (interrupt.hpp), while
// rendering continues. A write that fails is reported and retried at the next interval; the previous file stays intact.
class Checkpoints {
  public:
    Checkpoints(std::filesystem::path file, double interval_seconds, const FilmFileHeader& header, const Film& film);
    // Stops the thread after any write in progress.
    ~Checkpoints();

  private:
    void run(const std::stop_token& stop);

    std::filesystem::path file_;
    std::chrono::duration<double> interval_;
    const FilmFileHeader& header_;
    const Film& film_;
    std::mutex waiting_;
    std::condition_variable_any end_;
    std::jthread thread_;  // last, because it uses all other members
};

}  // namespace phasetree::tracer
