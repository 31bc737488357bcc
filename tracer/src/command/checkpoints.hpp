// What a render has done so far, kept in a file while it goes on.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "film/film.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

// While it lives, the film is written to the file every so often, and when SIGUSR1 arrives (interrupt.hpp); rendering
// goes on meanwhile. Where it cannot be written this is said, and tried again the next time: the file then is the one
// before.
class Checkpoints {
  public:
    Checkpoints(std::filesystem::path file, double interval_seconds, const FilmFileHeader& header, const Film& film);
    // Ends that, after a file that is being written.
    ~Checkpoints();

  private:
    void run(const std::stop_token& stop);

    std::filesystem::path file_;
    std::chrono::duration<double> interval_;
    const FilmFileHeader& header_;
    const Film& film_;
    std::mutex waiting_;
    std::condition_variable_any end_;
    std::jthread thread_;  // last: it uses all the others
};

}  // namespace phasetree::tracer
