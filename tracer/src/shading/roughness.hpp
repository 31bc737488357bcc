// The roughness below which a surface is treated as perfectly smooth.
#pragma once

namespace phasetree::tracer {

/// A surface whose roughness (the α of GGX) is below this is treated as perfectly smooth; no eye sees the difference.
inline constexpr float least_roughness = 1e-3f;
inline bool is_smooth(float roughness) {
    return !(roughness >= least_roughness);
}

}  // namespace phasetree::tracer
