// Values of a program at many points, in plain C++: the implementation of the Python functions, and the baseline for
// their cost.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "arrays.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::python {

/// Points per block. A block takes a few hundred microseconds for a program of medium size.
inline constexpr std::size_t points_a_block = 2048;

struct PointBatch {
    BatchOfFloats x, y, z;
    std::size_t count = 0;

    /// The points from `begin` on, at most a batch. The remaining lanes are filled with the last point.
    PointBatch(const float* points, std::size_t begin, std::size_t end) : count(std::min(batch_size, end - begin)) {
        for (std::size_t k = 0; k < batch_size; ++k) {
            const float* p = points + 3 * (begin + std::min(k, count - 1));
            x[k] = p[0];
            y[k] = p[1];
            z[k] = p[2];
        }
    }
    bool is_finite(std::size_t k) const { return std::isfinite(x[k]) && std::isfinite(y[k]) && std::isfinite(z[k]); }
};

/// The phase at each point; the vacuum if a coordinate is not finite.
inline void labels_at(const Evaluator& evaluator, const float* points, std::size_t begin, std::size_t end,
                      std::uint8_t* labels) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    for (std::size_t i = begin; i < end; i += batch_size) {
        const PointBatch batch(points, i, end);
        Samples samples;
        evaluator.sample(batch.x, batch.y, batch.z, samples, workspace);
        for (std::size_t k = 0; k < batch.count; ++k)
            labels[i + k] = batch.is_finite(k) ? static_cast<std::uint8_t>(samples.label[k]) : std::uint8_t{0};
    }
}

/// Φ at each point, in rows of `columns` numbers. Column i is the distance of phase i, infinite if the object never has
/// it; NaN if a coordinate is not finite.
inline void distances_at(const Evaluator& evaluator, const float* points, std::size_t begin, std::size_t end,
                         std::size_t columns, float* phi) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    const std::vector<Output>& outputs = evaluator.program().outputs;
    std::array<BatchOfFloats, Phase::capacity> values;
    for (std::size_t i = begin; i < end; i += batch_size) {
        const PointBatch batch(points, i, end);
        evaluator.evaluate(batch.x, batch.y, batch.z, std::span(values).first(outputs.size()), workspace);
        for (std::size_t k = 0; k < batch.count; ++k) {
            float* const row = phi + (i + k) * columns;
            const bool is_known = batch.is_finite(k);
            for (std::size_t c = 0; c < columns; ++c)
                row[c] = is_known ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
            if (!is_known) continue;
            for (std::size_t o = 0; o < outputs.size(); ++o) row[outputs[o].phase.index] = values[o][k];
        }
    }
}

/// One component of Φ at each point; NaN if a coordinate is not finite.
inline void components_at(const Evaluator& evaluator, const float* points, std::size_t begin, std::size_t end,
                          Phase phase, float* values) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    const std::vector<Output>& outputs = evaluator.program().outputs;
    std::array<BatchOfFloats, Phase::capacity + 1> all;
    std::size_t own = 0;
    while (own < outputs.size() && outputs[own].phase != phase) ++own;
    all[own].lane.fill(std::numeric_limits<float>::infinity());  // if the phase is absent
    for (std::size_t i = begin; i < end; i += batch_size) {
        const PointBatch batch(points, i, end);
        evaluator.evaluate(batch.x, batch.y, batch.z, std::span(all).first(outputs.size()), workspace);
        for (std::size_t k = 0; k < batch.count; ++k)
            values[i + k] = batch.is_finite(k) ? all[own][k] : std::numeric_limits<float>::quiet_NaN();
    }
}

/// The gradient of one phase's component at each point. Without a phase, uses the phase at each point.
inline void gradients_at(const Evaluator& evaluator, const float* points, std::size_t begin, std::size_t end,
                         std::optional<Phase> phase, float* gradients) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    for (std::size_t i = begin; i < end; ++i) {
        const glm::vec3 p = point(points, i);
        put(gradients, i,
            is_finite(p) ? evaluator.gradient(p, phase ? *phase : evaluator.label(p, workspace))
                         : glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
}

}  // namespace phasetree::python
