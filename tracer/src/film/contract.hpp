// Requirements on a plane of the film (an AOV in other renderers). A plane records a quantity at each pixel, such as
// the radiance that arrives there. planes.hpp lists all planes. The planes of a film are chosen when it is made.
//
// The contents of a film are sums (below) whose result does not depend on the order of the samples, to the last bit. So
// samples may be divided among tiles, threads, machines and runs in any way. Each adds its own samples, and joining
// them gives the same result as a single thread, bit for bit.
#pragma once

#include <concepts>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/bytes.hpp"
#include "film/faults.hpp"

namespace phasetree::tracer {

struct PathRecord;

/// The contribution of one path to the film. Fields that are unknown keep their defaults.
struct FilmSample {
    glm::vec3 radiance{0};     ///< linear Rec.709, in the unit of the lights (lights/contract.hpp)
    std::uint32_t number = 0;  ///< number of the sample in its pixel, from 0
    float depth = 0;           ///< depth of the first surface, along the camera's axis from the plane that contains the
                               ///< camera
    const PathRecord* record = nullptr;  ///< further data of the path; null if no plane needs it
};

/// The names from which planes derive their channels.
struct SceneNames {
    std::vector<std::string> phases;   ///< in order, the vacuum first
    std::vector<std::string> groups;   ///< of lights, in the order of Lights::groups
    std::vector<std::string> objects;  ///< the object or objects of phases, then the meshes

    bool operator==(const SceneNames&) const = default;
};

/// A sum is what a plane keeps of the samples. Each kind of sum has its own way of adding a sample's value:
///
/// * ValueSum, SquareSum, WeightSum (sums/fixed_sum.hpp): exact sums of real numbers
/// * MeanAndVariance (sums/mean_and_variance.hpp): the mean, and the variance of that mean
/// * WeightedMean<N> (sums/weighted_mean.hpp): one exact sum divided by another
/// * Count (sums/count.hpp): the number of events
/// * FirstValue<N> (sums/first_value.hpp): the value of the sample with the lowest number
/// * WeightsById (sums/weights_by_id.hpp): exact weights by 32-bit numbers
///
/// A kind of sum guarantees:
///
/// * A value-initialised sum contains no samples.
/// * a += b joins two sums of different samples. The result, as compared by == and write(), does not depend on how
///   samples were divided among sums, nor on the order in which samples were added and sums were joined.
/// * read() restores the sum written by write(), and equal sums write equal bytes. read() accepts any bytes. It uses at
///   most a small multiple of their size in memory, and throws BytesError if write() cannot have written them. It need
///   not reject invalid values that do no harm.
template <class S>
concept SumKind = std::regular<S> && requires(S& sum, const S& other, ByteWriter& out, ByteReader& in) {
    { sum += other } -> std::same_as<S&>;
    { other.write(out) } -> std::same_as<void>;
    { S::read(in) } -> std::same_as<S>;
};

/// A plane keeps the same number of sums of one kind at each pixel. Its own members are constant once the film is made.
///
/// * Sum: the kind of its sums.
/// * name: its name, as in --planes.
/// * by_default: whether a film has it by default.
/// * P(scene_names): the plane of a scene.
/// * channels(): the channels' names in EXR: "R", or "layer.R" for those of a layer. May be empty.
/// * sums(): the number of sums per pixel. A plane that is not chosen keeps nothing.
/// * add(sums, sample, faults): adds a sample to the sums of its pixel. The sums change values that they cannot
///   represent (NaN), and count them in `faults`.
/// * attributes(), optional: attributes for the header of a file, as pairs of names and texts.
/// * resolve(sums, samples, values): computes the channels' values at a pixel with this many samples, at least one.
///   `values` is initially zero.
template <class P>
concept PlaneKind = SumKind<typename P::Sum> && std::constructible_from<P, const SceneNames&> && std::copyable<P> &&
    requires(const P& plane, std::span<typename P::Sum> sums, std::span<const typename P::Sum> done,
             const FilmSample& sample, std::uint32_t samples, std::span<float> values, FilmFaults& faults) {
    { P::name } -> std::convertible_to<std::string_view>;
    { P::by_default } -> std::convertible_to<bool>;
    { plane.channels() } -> std::same_as<std::vector<std::string>>;
    { plane.sums() } -> std::same_as<std::size_t>;
    { plane.add(sums, sample, faults) } -> std::same_as<void>;
    { plane.resolve(done, samples, values) } -> std::same_as<void>;
};

}  // namespace phasetree::tracer
