// Below which roughness a surface is treated as smooth.
#pragma once

namespace phasetree::tracer {

/// The least roughness (the α of GGX) that is not treated as none: no eye tells it from that.
inline constexpr float least_roughness = 1e-3f;
inline bool is_smooth(float roughness) {
    return !(roughness >= least_roughness);
}

}  // namespace phasetree::tracer
