#pragma once

#include <cstdint>

namespace phasetree::bench {

// What tracing a set of rays gave; keeps it from being optimised away, and says whether two ways gave the same.
struct Checksum {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    double distance = 0;  // the sum over hits

    Checksum& operator+=(const Checksum& o) {
        rays += o.rays;
        hits += o.hits;
        distance += o.distance;
        return *this;
    }
    bool operator==(const Checksum&) const = default;
};

}  // namespace phasetree::bench
