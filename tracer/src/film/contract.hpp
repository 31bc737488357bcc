// What a plane of the film must provide: something that is measured at each pixel, such as the radiance that arrives
// there. planes.hpp has the list of all planes.
#pragma once

#include <array>
#include <concepts>
#include <glm/vec3.hpp>
#include <string_view>

namespace phasetree::tracer {

/// What one path brings to the film.
struct FilmSample {
    glm::vec3 radiance;  ///< linear Rec.709, in the unit of the lights (lights/contract.hpp)
};

/// A plane is a type without values; the film keeps a Sum for each pixel.
///
/// * Sum: what is accumulated at a pixel. A value-initialised one stands for no samples.
/// * channels: an array of the channels' names, as EXR spells them: "R", or "layer.R" for those of a layer.
/// * add(sum, sample): accumulates a sample. The samples of a pixel are added in the order of their numbers, so that
///   rounding is the same for any number of threads.
/// * resolve(sum, samples): the channels' values at a pixel with so many samples, at least one.
template <class P>
concept PlaneKind = std::regular<typename P::Sum> &&
    requires(typename P::Sum& sum, const typename P::Sum& done, const FilmSample& sample, int samples) {
    { P::channels[0] } -> std::convertible_to<std::string_view>;
    { P::add(sum, sample) } -> std::same_as<void>;
    { P::resolve(done, samples) } -> std::same_as<std::array<float, P::channels.size()>>;
};

}  // namespace phasetree::tracer
