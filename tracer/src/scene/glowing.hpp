// Where the phases and meshes are that shine by themselves, by their surface or by the medium inside: balls around
// parts of them, towards which shadow rays are sent (lights/glowing_part.hpp).
//
// Which balls there are is a matter of noise alone: what shines outside all balls is found by the paths' directions,
// and by shadow rays that something else proposed.
#pragma once

namespace phasetree::tracer {

struct Scene;

/// Adds the balls to the scene's lights, and the groups of lights that its materials name. The scene has all else, but
/// for Lights::cluster_lamps(), which is to be called after this. Throws ModelError for a tree that cannot be traced.
void find_glowing_parts(Scene&);

}  // namespace phasetree::tracer
