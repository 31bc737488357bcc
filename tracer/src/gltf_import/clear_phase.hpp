// glTF's clear materials as materials of phases.
//
// | glTF | "clear" | |
// |---|---|---|
// | ior | ior | exact |
// | dispersion d | abbe_number 20/d, and "spectral" | exact for 10 to 1000; smooth materials without a film only |
// | roughness r | roughness r² | exact: glTF's α |
// | attenuation colour c after distance d | color c, color_distance d | exact: a = −ln(c)/d |
// | iridescence | film_thickness, film_ior | exact for a factor of 1 |
// | base colour t | absorption increased by −2 ln(t)/l | approximate |
//
// glTF tints light by the base colour at each crossing of the surface. Here, light that crosses two surfaces and the
// mean chord between them, l = 4 volume/area, gets the same colour. Abbe numbers below 10 are raised to 10; dispersion
// with one above 1000 is dropped.
#pragma once

#include <string>
#include <vector>

#include "gltf/clear_material.hpp"
#include "gltf_import/json_layout.hpp"

namespace phasetree::tracer::gltf_import {

/// The material. `mean_chord` is that of all solids of the material, in metres. Appends to `losses` what is lost or
/// approximate, as predicates to be printed after the material's name, such as "loses its dispersion".
SceneJson clear_phase(const gltf::ClearMaterial&, double mean_chord, std::vector<std::string>& losses);

}  // namespace phasetree::tracer::gltf_import
