#include "shading/principled_surface.hpp"

#include <algorithm>
#include <cmath>

#include "shading/roughness.hpp"

namespace phasetree::tracer {

namespace {

// GGX's α of a roughness, 0 if it is treated as smooth.
float alpha_of(float roughness) {
    const float alpha = roughness * roughness;
    return is_smooth(alpha) ? 0.0f : std::min(alpha, 1.0f);
}
ValueRange alpha_of(const ValueRange& roughness) {
    return {alpha_of(roughness.least), alpha_of(roughness.greatest)};
}

// The α of a base below a rough coat: slopes add up, and light passes the coat twice.
float roughened(float alpha, float of_coat) {
    return std::min(1.0f, std::sqrt(alpha * alpha + 2.0f * of_coat * of_coat));
}

float fraction(float value) {
    return std::clamp(value, 0.0f, 1.0f);
}

}  // namespace

PrincipledSurface::PrincipledSurface(const PrincipledRanges& ranges, SharedSurfaces& shared) : ranges_(ranges) {
    const ValueRange alpha = alpha_of(ranges.roughness), of_coat = alpha_of(ranges.coat_roughness);
    if (ranges.film && ranges.metalness.greatest > 0.0f) film_colours_ = shared.film_colours();
    if (ranges.coat_weight.least < 1.0f) bare_ = base_of(ranges.outside, alpha, shared);
    if (ranges.coat_weight.greatest > 0.0f) {
        coat_ = shared.layer({ranges.outside, ranges.coat_ior, of_coat});
        coated_ = base_of(ranges.coat_ior,
                          {roughened(alpha.least, of_coat.least), roughened(alpha.greatest, of_coat.greatest)}, shared);
    }
    if (ranges.fuzz_weight.greatest > 0.0f)
        fuzz_ =
            shared.fuzz({Fuzz::alpha_of(ranges.fuzz_roughness.least), Fuzz::alpha_of(ranges.fuzz_roughness.greatest)});
}

PrincipledSurface::Base PrincipledSurface::base_of(float outside, const ValueRange& alpha,
                                                   SharedSurfaces& shared) const {
    Base base{outside, nullptr, nullptr};
    const bool has_metal = ranges_.metalness.greatest > 0.0f;
    if (has_metal) {
        std::optional<ValueRange> rough;
        if (alpha.greatest > 0.0f) rough = {std::max(alpha.least, least_roughness), alpha.greatest};
        base.metal = shared.metal_of_reflectance(outside, rough, ranges_.aspect);
    }
    if (!(ranges_.metalness.least < 1.0f)) {
        base.gloss = shared.layer({outside, outside, {}});  // not seen
        return base;
    }
    // Below a coat of a higher index, the ratio is inverted: at the base, light from outside is never reflected
    // totally.
    const bool is_inverted = outside != ranges_.outside && outside > ranges_.ior;
    const float from = is_inverted ? ranges_.ior : outside, to = is_inverted ? outside : ranges_.ior;
    base.gloss =
        shared.layer({from, to, alpha, ranges_.aspect, ranges_.film, ranges_.diffuse_roughness.greatest > 0.0f});
    return base;
}

PrincipledBase PrincipledSurface::at(const Base& base, float alpha, const PrincipledPoint& point,
                                     const Wavelengths* wavelengths) const {
    const glm::vec3 color = fraction(point.base_weight) * point.base_color;
    const float specular = fraction(point.specular_weight);
    const LayerFilm film{point.film_thickness, ranges_.film ? fraction(point.film_weight) : 0.0f};
    PrincipledBase::Kind kind{fraction(point.metalness), alpha, color, fraction(point.diffuse_roughness)};
    if (base.metal) {
        kind.metal.wavelengths = wavelengths;
        kind.metal.by_colours = F82Metal{color, point.specular_color, specular};
        if (film.weight > 0.0f)
            kind.metal.by_colours->film =
                F82Metal::Film{film_colours_.get(), base.outside, ranges_.film->ior, film.thickness, film.weight};
    }
    return {kind, base.gloss->at(alpha, specular * point.specular_color, film, wavelengths), base.metal.get()};
}

PrincipledBsdf PrincipledSurface::at(const PrincipledPoint& point, const Wavelengths* wavelengths) const {
    const float alpha = alpha_of(point.roughness), of_coat = alpha_of(point.coat_roughness);
    const float coat_weight = coated_ ? bare_ ? fraction(point.coat_weight) : 1.0f : 0.0f;
    const auto coated = [&] { return at(*coated_, roughened(alpha, of_coat), point, wavelengths); };
    // Where all of it is coated, the bare base has no weight.
    PrincipledBsdf bsdf(coat_weight < 1.0f ? at(*bare_, alpha, point, wavelengths) : coated());
    if (coat_weight > 0.0f)
        bsdf.add(PrincipledCoat{coat_weight, point.coat_color, fraction(point.coat_darkening),
                                ranges_.coat_ior / ranges_.outside},
                 coat_->at(of_coat, glm::vec3(1.0f), {}, wavelengths), coated());
    if (fuzz_)
        bsdf.add(PrincipledFuzz{fraction(point.fuzz_weight), point.fuzz_color},
                 Fuzz(*fuzz_, Fuzz::alpha_of(point.fuzz_roughness)));
    return bsdf;
}

}  // namespace phasetree::tracer
