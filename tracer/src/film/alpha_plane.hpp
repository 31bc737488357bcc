// How much of a pixel is covered: the share of the samples in which the camera ray meets something, be it a surface, a
// lamp that it sees, or a place in a medium where it is scattered. Glass covers what is behind it, because it bends it.
#pragma once

#include "film/recorded_plane.hpp"

namespace phasetree::tracer {

struct Coverage {
    static constexpr std::string_view name = "alpha";
    static constexpr std::array<std::string_view, 1> channels{"A"};  // as EXR and compositors call it
    static std::optional<std::array<float, 1>> of(const FilmSample& s) {
        if (!s.record) return std::nullopt;
        return std::array{s.record->shows_background ? 0.0f : 1.0f};
    }
};

using AlphaPlane = MeanPlane<Coverage>;

}  // namespace phasetree::tracer
