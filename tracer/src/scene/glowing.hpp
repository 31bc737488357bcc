// Where the phases and meshes are that shine by themselves: balls around parts of their surfaces, towards which shadow
// rays are sent (lights/glowing_part.hpp).
//
// A phase's component of the tree's distances is 1-Lipschitz and negative inside of the phase. So a box, whose centre
// is nowhere farther than r from its points, has none of the phase's surface if |φ(centre)| > r. From the object's
// bounds boxes are divided into eight as long as few enough are left, and of the last ones each becomes a ball.
//
// Which balls there are is a matter of noise alone: the light of what none covers is found by the paths' directions.
#pragma once

namespace phasetree::tracer {

struct Scene;

/// Adds the balls to the scene's lights, and the groups of lights that its materials name. The scene has all else, but
/// for Lights::cluster_lamps(), which is to be called after this.
void find_glowing_parts(Scene&);

}  // namespace phasetree::tracer
