#include "gltf/thin_material.hpp"

#include <utility>

namespace phasetree::tracer::gltf {

namespace {

// A share above this everywhere counts as 1.
constexpr float nearly_all = 0.99f;

Material mixed(Material first, Material second, const Number& share) {
    return Mix{std::make_shared<const Mixture>(Mixture{std::move(first), std::move(second)}), share};
}

// The texture times a number.
Texture scaled(const Texture& texture, float by) {
    if (const auto* image = std::get_if<TintedMeshImage>(&texture)) {
        TintedMeshImage darker = *image;
        darker.factor *= by;
        return darker;
    }
    return ConstantTexture{by * std::get<ConstantTexture>(texture).color};
}

}  // namespace

bool has_volume(const Item& material) {
    const auto volume = material.extension("KHR_materials_volume");
    // Some programs write the extension only for its absorption.
    return volume && (volume->number("thicknessFactor", 1) > 0 || volume->has("attenuationDistance"));
}

Material with_pane(Material opaque, ThinGlass pane, const Number& share) {
    if (least_of(share) > nearly_all) return pane;
    return mixed(std::move(opaque), std::move(pane), share);
}

Material with_diffuse_transmission(const Diffuse& opaque, const TintedMeshImage& color, const Texture& transmitted,
                                   const Number& share) {
    if (const float* const constant = std::get_if<float>(&share))
        return ThinDiffuse{scaled(color, 1.0f - *constant), scaled(transmitted, *constant), opaque.perturbation};
    return mixed(opaque, ThinDiffuse{ConstantTexture{glm::vec3(0.0f)}, transmitted, opaque.perturbation}, share);
}

}  // namespace phasetree::tracer::gltf
