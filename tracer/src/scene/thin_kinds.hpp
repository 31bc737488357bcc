// The kinds of materials that only meshes can have: thin ones, and those that differ between the sides. Each has the
// member for_meshes_only.
#pragma once

#include <optional>

#include "scene/surface_parameters.hpp"

namespace phasetree::tracer {

struct ThinGlassParameters : PerturbationParameters {
    static constexpr KindInfo info{"thin_glass",
                                   "Window pane, foil: glass so thin that light goes straight through. All reflections "
                                   "between its two faces count. "
                                   "Only meshes can have it; a pane is a single layer of triangles, not a closed box.",
                                   "R = 2 r/(1 + r)"};
    static constexpr bool for_meshes_only = true;

    float ior = ThinGlass{}.ior;
    Texture color = ThinGlass{}.color;
    std::optional<float> thickness{};
    std::optional<float> color_distance{};
    Number roughness = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = ThinGlassParameters;
        v(&P::ior,
          Parameter{"ior", "", "Refractive index relative to vacuum. What counts is its ratio to that around it.",
                    Limits{.low = 0.1f, .high = 10}, true});
        v(&P::color, Parameter{"color", "",
                               "Colour of white light that crosses the glass once, perpendicularly and without "
                               "reflections; default white. Slanted light crosses more glass.",
                               limits::any, true});
        v(&P::thickness, Parameter{"thickness", "m",
                                   "Thickness of the pane, for its colour: the colour is then that after "
                                   "\"color_distance\", as in \"clear\". The pane remains a surface.",
                                   limits::positive, true});
        v(&P::color_distance, Parameter{"color_distance", "m",
                                        "With a thickness: the distance after which white light has the colour; "
                                        "default 1.",
                                        limits::positive, true});
        v(&P::roughness, Parameter{"roughness", "",
                                   "Roughness α of GGX: 0 is clear, 0.2 frosted. Light is then blurred as much in "
                                   "transmission as in reflection, which is more than two rough faces do.",
                                   limits::fraction, true});
        perturbation_parameters<P>(v);
    }
    ThinGlass made() const;
};

struct ThinDiffuseParameters : PerturbationParameters {
    static constexpr KindInfo info{"thin_diffuse",
                                   "Leaf, paper, lampshade: a sheet that reflects light diffusely, and transmits some "
                                   "of it diffusely to the other "
                                   "side. It is the same from both sides. Only meshes can have it."};
    static constexpr bool for_meshes_only = true;

    Texture color{};
    Texture transmission{};

    template <class V>
    static void parameters(V&& v) {
        using P = ThinDiffuseParameters;
        v(&P::color, Parameter{"color", "", "Reflectance.", limits::any});
        v(&P::transmission, Parameter{"transmission", "",
                                      "Transmittance. Where the sum with the reflectance exceeds 1 in a channel, both "
                                      "are divided by the sum.",
                                      limits::any});
        perturbation_parameters<P>(v);
    }
    ThinDiffuse made() const { return {color, transmission, perturbation()}; }
};

struct TwoSidedParameters {
    static constexpr KindInfo info{
        "two_sided",
        "Playing card, lined fabric, banknote: an opaque mesh with different materials on its sides. The front is the "
        "side of the mesh's normals; without normals, that from which the corners of a triangle are in "
        "counter-clockwise order. Neither material may be clear, thin or emit light."};
    static constexpr bool for_meshes_only = true;

    Material front{};
    Material back{};

    template <class V>
    static void parameters(V&& v) {
        using P = TwoSidedParameters;
        v(&P::front, Parameter{"front", "", "Material of the front."});
        v(&P::back, Parameter{"back", "", "Material of the back."});
    }
    TwoSided made() const;
};

}  // namespace phasetree::tracer
