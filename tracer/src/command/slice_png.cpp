#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "command/slice_picture.hpp"
#include "image/write_palette_png.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

std::string slice_png(const Program& program, const SlicePlane& plane, const SliceFrame& frame, int size,
                      const std::function<bool()>& cancelled, const std::function<void(double)>& progress) {
    const glm::dvec2 low(frame.low), extent = glm::dvec2(frame.high) - low;
    const double pixel = std::max(extent.x, extent.y) / size;
    // Bounds are slightly larger than the object.
    const auto pixels = [&](double length) {
        return static_cast<std::size_t>(std::clamp(std::ceil(length / pixel - 0.01), 1.0, static_cast<double>(size)));
    };
    const std::size_t width = pixels(extent.x), height = pixels(extent.y);
    std::vector<std::uint8_t> labels(width * height);
    const Evaluator evaluator(program);
    std::mutex one_at_a_time;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t row) {
        if (cancelled()) throw SlicingCancelled();
        const FlushSubnormals flush;
        const auto v = static_cast<float>(low.y + (static_cast<double>(height - 1 - row) + 0.5) * pixel);
        for (std::size_t first = 0; first < width; first += batch_size) {
            std::array<BatchOfFloats, 3> p{};
            for (std::size_t i = 0; i < batch_size; ++i) {
                const auto u = static_cast<float>(low.x + (static_cast<double>(first + i) + 0.5) * pixel);
                const glm::vec3 point = plane.point(u, v);
                for (std::size_t k = 0; k < 3; ++k) p[k][i] = point[static_cast<int>(k)];
            }
            Samples samples;
            evaluator.sample(p[0], p[1], p[2], samples, Evaluator::thread_workspace());
            for (std::size_t i = 0; i < std::min(batch_size, width - first); ++i)
                labels[row * width + first + i] = static_cast<std::uint8_t>(samples.label[i]);
        }
        const std::lock_guard lock(one_at_a_time);
        progress(static_cast<double>(++done) / static_cast<double>(height));
    });
    return palette_png(static_cast<int>(width), labels, frame.colors);
}

}  // namespace phasetree::tracer
