// What a plane of the film must provide: something that is measured at each pixel, such as the radiance that arrives
// there. planes.hpp has the list of all planes; which of them a film keeps is chosen when it is made.
//
// Nothing that a film records depends on the order in which samples arrive, because all of it is made of sums (below)
// for which that is so. So samples may be divided among tiles, threads, machines and runs at will, each adds up its
// own, and joining these gives what one thread alone would have had, bit for bit.
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

/// What one path brings to the film. Who makes one leaves out what he does not know.
struct FilmSample {
    glm::vec3 radiance{0};     ///< linear Rec.709, in the unit of the lights (lights/contract.hpp)
    std::uint32_t number = 0;  ///< of the sample in its pixel, from 0
    float depth = 0;           ///< of the first surface, along the camera's axis from the plane in which the camera is
    const PathRecord* record = nullptr;  ///< what else the path has to tell; none if no plane asks for it
};

/// What planes name channels after.
struct PlaneSubjects {
    std::vector<std::string> phases;   ///< in order, the vacuum first
    std::vector<std::string> groups;   ///< of lights, in the order of Lights::groups
    std::vector<std::string> objects;  ///< the object of phases, or several, then the meshes

    bool operator==(const PlaneSubjects&) const = default;
};

/// A sum is what a plane keeps of the samples. Each kind of sum has its own way to add a sample's value:
///
///     ValueSum, SquareSum, WeightSum   sums/fixed_sum.hpp          exact sums of real numbers
///     MeanAndVariance                  sums/mean_and_variance.hpp  the mean, and the variance of that mean
///     WeightedMean<N>                  sums/weighted_mean.hpp      one exact sum divided by another
///     Count                            sums/count.hpp              how often something happened
///     FirstValue<N>                    sums/first_value.hpp        what the sample of the lowest number brought
///     WeightsById                      sums/weights_by_id.hpp      exact weights by 32-bit numbers
///
/// A new kind promises:
///
/// * A value-initialised sum stands for no samples.
/// * a += b joins two sums of different samples. The result is the same, as == and write() have it, however samples
///   were divided among sums, in whatever order they were added to these, and in whatever order those are joined.
/// * write() and read() give the same sum back. Equal sums write equal bytes. read() takes no more memory than a small
///   multiple of the bytes, whatever they are, and throws BytesError for bytes that write() cannot have written as far
///   as that matters to the rest of the program.
template <class S>
concept SumKind = std::regular<S> && requires(S& sum, const S& other, ByteWriter& out, ByteReader& in) {
    { sum += other } -> std::same_as<S&>;
    { other.write(out) } -> std::same_as<void>;
    { S::read(in) } -> std::same_as<S>;
};

/// A plane keeps the same number of sums of one kind at each pixel. Its own values are fixed when the film is made.
///
/// * Sum: the kind of its sums.
/// * name: how it is asked for, as in --planes.
/// * by_default: whether a film keeps it if nobody chooses.
/// * P(subjects): the plane of a scene.
/// * channels(): the channels' names, as EXR spells them: "R", or "layer.R" for those of a layer. There may be none.
/// * sums(): how many it keeps at a pixel. Of a plane that is not chosen nothing is kept.
/// * add(sums, sample, faults): adds a sample to the sums of its pixel. Values that no sum can take as they are (a NaN)
///   are changed by the sums, which count them in `faults`.
/// * attributes(), which may be missing: what the header of a file says of it, as pairs of names and texts.
/// * resolve(sums, samples, values): the channels' values at a pixel with this many samples, at least one. It is given
///   zeros.
template <class P>
concept PlaneKind = SumKind<typename P::Sum> && std::constructible_from<P, const PlaneSubjects&> && std::copyable<P> &&
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
