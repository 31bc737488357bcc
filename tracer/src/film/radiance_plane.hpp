// The picture: the mean radiance of a pixel's samples.
#pragma once

#include "film/contract.hpp"
#include "film/sums/fixed_sum.hpp"

namespace phasetree::tracer {

struct RadiancePlane {
    using Sum = ValueSum;
    static constexpr std::string_view name = "beauty";
    static constexpr bool by_default = true;

    explicit RadiancePlane(const SceneNames&) {}

    std::vector<std::string> channels() const { return {"R", "G", "B"}; }
    std::size_t sums() const { return 3; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        for (int c = 0; c < 3; ++c)
            sums[static_cast<std::size_t>(c)].add(static_cast<double>(sample.radiance[c]), faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        for (std::size_t c = 0; c < 3; ++c) values[c] = static_cast<float>(sums[c].value() / samples);
    }
};

}  // namespace phasetree::tracer
