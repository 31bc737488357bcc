#include "shading/shared_surfaces.hpp"

#include <algorithm>
#include <utility>

namespace phasetree::tracer {

namespace {

// Returns the value cached for this key, or makes it.
template <class Made, class Key, class Make>
auto found_or_made(Made& made, const Key& key, const Make& make) {
    const auto found = std::ranges::find(made, key, &Made::value_type::first);
    if (found != made.end()) return found->second;
    auto surface = make();
    made.emplace_back(key, surface);
    return surface;
}

}  // namespace

std::shared_ptr<const DielectricSurface> SharedSurfaces::dielectric(float ior_from, float ior_to,
                                                                    const std::optional<ValueRange>& roughness,
                                                                    const std::optional<FilmOfSurface>& film) {
    return found_or_made(dielectrics_, Dielectric{ior_from, ior_to, roughness, film}, [&] {
        const auto other = std::ranges::find(dielectrics_, Dielectric{ior_to, ior_from, roughness, film},
                                             &decltype(dielectrics_)::value_type::first);
        if (other != dielectrics_.end()) return std::make_shared<const DielectricSurface>(other->second->reversed());
        return found_or_made(computed_dielectrics_, Dielectric{ior_from, ior_to, roughness, film}, [&] {
            return std::make_shared<const DielectricSurface>(ior_from, ior_to, roughness, film, films_);
        });
    });
}

std::shared_ptr<const ConductorSurface> SharedSurfaces::conductor(float ior, const glm::vec3& eta, const glm::vec3& k,
                                                                  const std::optional<ValueRange>& roughness,
                                                                  const std::optional<FilmOfSurface>& film,
                                                                  std::span<const MetalPoint> spectrum, float aspect) {
    return found_or_made(conductors_, Conductor{ior, eta, k, roughness, film, spectrum.data(), aspect}, [&] {
        return std::make_shared<const ConductorSurface>(ior, eta, k, roughness, film, spectrum, aspect,
                                                        losses(roughness, aspect));
    });
}

std::shared_ptr<const ConductorSurface> SharedSurfaces::metal_of_reflectance(float ior,
                                                                             const std::optional<ValueRange>& roughness,
                                                                             float aspect) {
    return found_or_made(metals_of_reflectance_, MetalOfReflectance{ior, roughness, aspect}, [&] {
        return std::make_shared<const ConductorSurface>(
            ConductorSurface::of_reflectance(ior, roughness, aspect, losses(roughness, aspect)));
    });
}

std::shared_ptr<const LossTables> SharedSurfaces::losses(const std::optional<ValueRange>& roughness, float aspect) {
    if (!roughness) return nullptr;
    return found_or_made(metal_losses_, MetalLosses{*roughness, aspect},
                         [&] { return ConductorSurface::losses_of(*roughness, aspect); });
}

std::shared_ptr<const CoatingAlbedo> SharedSurfaces::coating(float ior_from, float ior_coat,
                                                             const ValueRange& roughness,
                                                             const std::optional<FilmOfSurface>& film) {
    return found_or_made(coatings_, Coating{ior_from, ior_coat, roughness, film}, [&] {
        return std::make_shared<const CoatingAlbedo>(DielectricSurface(ior_from, ior_coat, std::nullopt, film, films_),
                                                     roughness, film ? film->thickness : ValueRange{});
    });
}

std::shared_ptr<const DielectricLayer> SharedSurfaces::layer(const DielectricLayer::Kind& kind) {
    return found_or_made(layers_, kind, [&] { return std::make_shared<const DielectricLayer>(kind, films_); });
}

std::shared_ptr<const LossTables> SharedSurfaces::fuzz(const ValueRange& alpha) {
    return found_or_made(fuzz_losses_, alpha,
                         [&] { return std::make_shared<const LossTables>(Fuzz::losses_of(alpha)); });
}

std::shared_ptr<const FilmColours> SharedSurfaces::film_colours() {
    if (!film_colours_) film_colours_ = std::make_shared<const FilmColours>();
    return film_colours_;
}

void SharedSurfaces::begin_scene() {
    const auto forget_unused = [](auto& made) {
        std::erase_if(made, [](const auto& one) { return one.second.use_count() == 1; });
    };
    dielectrics_.clear();
    forget_unused(computed_dielectrics_);
    forget_unused(conductors_);
    forget_unused(metals_of_reflectance_);
    forget_unused(metal_losses_);
    forget_unused(coatings_);
    forget_unused(layers_);
    forget_unused(fuzz_losses_);
    films_.forget_unused();
}

}  // namespace phasetree::tracer
