// Finds the emitting phases and meshes, whether their surface or their interior emits, and covers them with balls,
// towards which shadow rays are sent (lights/emissive_part.hpp).
//
// The choice of balls affects only the noise. Light from outside all balls is found by the directions that paths
// sample, and by shadow rays that were aimed at something else.
#pragma once

namespace phasetree::tracer {

struct Scene;

/// Adds the balls to the scene's lights, and the groups of lights that its materials name. Everything else in the scene
/// must be complete. Call Lights::cluster_lamps() afterwards. Throws ModelError for a tree that cannot be traced.
void find_emissive_parts(Scene&);

}  // namespace phasetree::tracer
