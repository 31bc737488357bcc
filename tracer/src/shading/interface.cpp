#include "shading/interface.hpp"

#include <algorithm>
#include <stdexcept>

namespace phasetree::tracer {

namespace {

constexpr float least_roughness = 1e-3f;

bool is_smooth(float roughness) {
    return !(roughness >= least_roughness);
}

// optics_of() gives the optics of each kind of material, seen from within a clear one.

Bsdf optics_of(const Clear& from, const Clear& to) {
    const float roughness = std::max(from.roughness, to.roughness);
    if (from.ior == to.ior || is_smooth(roughness)) return Bsdf(SmoothDielectricBsdf(from.ior, to.ior));
    return Bsdf(RoughDielectricBsdf(from.ior, to.ior, std::min(roughness, 1.0f)));
}

Bsdf optics_of(const Clear& from, const Conductor& to) {
    const glm::vec3 eta = to.eta / from.ior;
    const glm::vec3 k = to.k / from.ior;
    if (is_smooth(to.roughness)) return Bsdf(SmoothConductorBsdf(eta, k));
    return Bsdf(RoughConductorBsdf(eta, k, std::min(to.roughness, 1.0f)));
}

TexturedOptics optics_of(const Clear&, const Diffuse& to) {
    return {std::make_shared<const Texture>(to.color), nullptr};
}

TexturedOptics optics_of(const Clear& from, const Coated& to) {
    const float roughness = is_smooth(to.roughness) ? 0.0f : std::min(to.roughness, 1.0f);
    return {std::make_shared<const Texture>(to.color),
            std::make_shared<const CoatingAlbedo>(to.ior / from.ior, roughness)};
}

}  // namespace

Interface Interface::between(const Material& from, const Material& to) {
    const Clear* clear = std::get_if<Clear>(&from);
    if (clear == nullptr) return Interface(Bsdf(DiffuseBsdf(glm::vec3{0.0f})));
    return std::visit([&](const auto& material) { return Interface(optics_of(*clear, material)); }, to);
}

Bsdf Interface::at(const glm::vec3& position) const& {
    if (const Bsdf* bsdf = std::get_if<Bsdf>(&optics_)) return *bsdf;
    const TexturedOptics& textured = std::get<TexturedOptics>(optics_);
    const glm::vec3 color = color_at(*textured.color, position);
    if (textured.coating == nullptr) return Bsdf(DiffuseBsdf(color));
    return Bsdf(CoatedDiffuseBsdf(*textured.coating, color));
}

InterfaceTable::InterfaceTable(std::span<const Material> materials) : count_(materials.size()) {
    interfaces_.reserve(count_ * count_);
    for (const Material& from : materials) {
        for (const Material& to : materials) interfaces_.push_back(Interface::between(from, to));
    }
}

const Interface& InterfaceTable::between(std::size_t from, std::size_t to) const {
    if (from >= count_ || to >= count_) throw std::out_of_range("interface table: there is no such material");
    return interfaces_[from * count_ + to];
}

}  // namespace phasetree::tracer
