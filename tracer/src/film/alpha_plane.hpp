// Alpha is the share of a pixel's samples whose camera ray is scattered, reflected or refracted, or ends at a surface
// or at a lamp that the camera sees. So smooth glass counts as opaque, because it bends what is seen through it. The
// picture is premultiplied by alpha only if the background is black.
#pragma once

#include "film/recorded_plane.hpp"

namespace phasetree::tracer {

struct Coverage {
    static constexpr std::string_view name = "alpha";
    static constexpr std::array<std::string_view, 1> channels{"A"};  // name in EXR and compositors
    static std::optional<std::array<float, 1>> of(const FilmSample& s) {
        if (!s.record) return std::nullopt;
        return std::array{s.record->shows_background ? 0.0f : 1.0f};
    }
};

using AlphaPlane = MeanPlane<Coverage>;

}  // namespace phasetree::tracer
