#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "embree_core/rays.hpp"
#include "measure/checksum.hpp"
#include "phasetree/math/float_mode.hpp"
#include "rays/ray.hpp"

namespace phasetree::bench {

inline RTCRayHit rayhit_of(const Ray& ray) {
    return embree::rayhit_of(ray.origin, ray.direction);
}

// Traces all rays with trace(ray), which gives the distance of a hit or nothing. The sum is the same for any number of
// threads: it is taken over parts of a fixed size, in their order.
template <class Trace>
Checksum trace_many(std::span<const Ray> rays, int threads, Trace&& trace) {
    constexpr std::size_t part_size = 512;
    const std::size_t parts = (rays.size() + part_size - 1) / part_size;
    const auto sum_of = [&](std::size_t part) {
        Checksum sum;
        const std::size_t first = part * part_size;
        for (const Ray& ray : rays.subspan(first, std::min(part_size, rays.size() - first))) {
            const std::optional<float> t = trace(ray);
            ++sum.rays;
            if (!t) continue;
            ++sum.hits;
            sum.distance += static_cast<double>(*t);
        }
        return sum;
    };
    Checksum all;
    if (threads == 1) {
        const FlushSubnormals flush;
        for (std::size_t part = 0; part < parts; ++part) all += sum_of(part);
        return all;
    }
    std::vector<Checksum> sums(parts);
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
            const FlushSubnormals flush;
            sums[part] = sum_of(part);
        });
    });
    for (const Checksum& sum : sums) all += sum;
    return all;
}

}  // namespace phasetree::bench
