// What the command line chose, for all subcommands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measure/in_turn.hpp"
#include "phasetree/building/options.hpp"

namespace phasetree::bench {

struct Settings {
    bool quick = false;
    int threads = 1;                // that trace; building is measured on one
    int width = 512, height = 512;  // of an image of one ray per pixel
    std::uint32_t seed = 1;
    // For `light` and `fingerprint`: scenes of the gallery instead of the usual few, or of all.
    std::vector<std::string> scenes{};
    // For `light`: samples per pixel, and another build's command `phasetree` to compare with.
    int samples = 16;
    std::optional<std::string> against{};

    // Processor time of one thread does not count what else the machine does; several threads have only the wall clock.
    Timing timing() const { return {quick ? 3 : 7, quick ? 0.02 : 0.15, threads == 1 ? Clock::thread : Clock::wall}; }
    Timing timing_of_one_thread() const { return {timing().rounds, timing().least_seconds, Clock::thread}; }
    BuildQuality quality() const { return quick ? BuildQuality::low : BuildQuality::medium; }
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

}  // namespace phasetree::bench
