// Several planes as one: the sums of the pixels of a rectangle, and the image made from them.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "film/contract.hpp"
#include "film/image.hpp"

namespace phasetree::tracer {

/// The first plane is the picture. It has three channels, which all formats support, and every film keeps it. The
/// others become extra channels of the image.
template <PlaneKind Picture, PlaneKind... Others>
struct PlaneList {
    static constexpr std::size_t size = 1 + sizeof...(Others);
    static constexpr std::array<std::string_view, size> names{Picture::name, Others::name...};

    /// The planes that a film keeps, in the order of the list.
    using Choice = std::bitset<size>;
    static Choice by_default() {
        Choice choice;
        std::size_t i = 0;
        choice[i++] = true;
        ((choice[i++] = Others::by_default), ...);
        return choice;
    }
    static Choice all() { return Choice().set(); }
    /// The index of a plane in the list.
    template <class Plane>
    static constexpr std::size_t index_of() {
        return static_cast<std::size_t>(std::ranges::find(names, Plane::name) - names.begin());
    }

    class Sums;

  private:
    // The sums of one plane.
    template <class Plane>
    struct PlaneSums {
        using Sum = typename Plane::Sum;

        PlaneSums(const SceneNames& scene_names, std::size_t pixels)
            : plane(scene_names), channels(plane.channels().size()), width(plane.sums()), sums(width * pixels) {}
        std::span<Sum> at(std::size_t pixel) { return std::span(sums).subspan(pixel * width, width); }
        std::span<const Sum> at(std::size_t pixel) const { return std::span(sums).subspan(pixel * width, width); }

        Plane plane;
        std::size_t channels;
        std::size_t width;      // sums per pixel
        std::vector<Sum> sums;  // pixel by pixel
    };
};

/// The sums of the chosen planes for this many pixels.
template <PlaneKind Picture, PlaneKind... Others>
class PlaneList<Picture, Others...>::Sums {
  public:
    Sums(const Choice& choice, const SceneNames& scene_names, std::size_t pixels) {
        std::size_t i = 0;
        each([&]<class Plane>(std::optional<PlaneSums<Plane>>& kept) {
            if (i == 0 || choice[i]) kept.emplace(scene_names, pixels);
            ++i;
        });
    }

    /// Adds a sample to a pixel.
    void add(std::size_t pixel, const FilmSample& sample, FilmFaults& faults) {
        each([&](auto& kept) {
            if (kept) kept->plane.add(kept->at(pixel), sample, faults);
        });
    }
    /// Joins the sums of a pixel of another film, which must have the same planes.
    void join(std::size_t pixel, const Sums& others, std::size_t theirs) {
        each([&]<class Plane>(std::optional<PlaneSums<Plane>>& kept) {
            if (!kept) return;
            const auto from = std::get<std::optional<PlaneSums<Plane>>>(others.kept_)->at(theirs);
            const auto to = kept->at(pixel);
            for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
        });
    }

    /// The sums of a plane at one pixel. The plane must be a chosen one.
    template <class Plane>
    std::span<const typename Plane::Sum> of(std::size_t pixel) const {
        return std::get<std::optional<PlaneSums<Plane>>>(kept_).value().at(pixel);
    }

    /// Writes the sums of one pixel, plane after plane.
    void write(std::size_t pixel, ByteWriter& out) const {
        each([&](const auto& kept) {
            if (!kept) return;
            for (const auto& sum : kept->at(pixel)) sum.write(out);
        });
    }
    /// Throws BytesError.
    void read(std::size_t pixel, ByteReader& in) {
        each([&]<class Plane>(std::optional<PlaneSums<Plane>>& kept) {
            if (!kept) return;
            for (auto& sum : kept->at(pixel)) sum = Plane::Sum::read(in);
        });
    }

    /// The names of all channels, those of the picture first.
    std::vector<std::string> channels() const {
        std::vector<std::string> names;
        each([&](const auto& kept) {
            if (!kept) return;
            const std::vector<std::string> more = kept->plane.channels();
            names.insert(names.end(), more.begin(), more.end());
        });
        return names;
    }
    /// The planes' attributes for the header of a file.
    std::vector<std::pair<std::string, std::string>> attributes() const {
        std::vector<std::pair<std::string, std::string>> all;
        each([&](const auto& kept) {
            if constexpr (requires { kept->plane.attributes(); }) {
                if (!kept) return;
                for (auto& attribute : kept->plane.attributes()) all.push_back(std::move(attribute));
            }
        });
        return all;
    }
    /// Writes the values of pixel `pixel` to position `target` of an image that has the extra channels of channels().
    /// `samples` is at least 1.
    void resolve(std::size_t pixel, std::uint32_t samples, Image& image, std::size_t target) const {
        std::size_t channel = 0;
        std::vector<float> values;
        each([&](const auto& kept) {
            if (!kept) return;
            values.assign(kept->channels, 0.0f);
            kept->plane.resolve(kept->at(pixel), samples, values);
            for (const float value : values) {
                if (channel < 3)
                    image.pixels[target][static_cast<int>(channel)] = value;
                else
                    image.extra_channels[channel - 3].values[target] = value;
                ++channel;
            }
        });
    }

    /// The minimum memory of one pixel: sums that grow (WeightsById) take more.
    std::size_t bytes_of_pixel() const {
        std::size_t bytes = 0;
        each([&]<class Plane>(const std::optional<PlaneSums<Plane>>& kept) {
            if (kept) bytes += kept->width * sizeof(typename Plane::Sum);
        });
        return bytes;
    }

  private:
    template <class F>
    void each(F&& f) {
        std::apply([&](auto&... kept) { (f(kept), ...); }, kept_);
    }
    template <class F>
    void each(F&& f) const {
        std::apply([&](const auto&... kept) { (f(kept), ...); }, kept_);
    }

    std::tuple<std::optional<PlaneSums<Picture>>, std::optional<PlaneSums<Others>>...> kept_;
};

}  // namespace phasetree::tracer
