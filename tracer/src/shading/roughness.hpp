// The roughness below which a surface is perfectly smooth.
#pragma once

namespace phasetree::tracer {

/// A surface with a roughness (the α of GGX) below this is treated as perfectly smooth; the difference is invisible.
inline constexpr float least_roughness = 1e-3f;
inline bool is_smooth(float roughness) {
    return !(roughness >= least_roughness);
}

}  // namespace phasetree::tracer
