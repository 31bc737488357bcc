// Several planes as one: what they accumulate at a pixel, and how an image is written from that.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "film/contract.hpp"
#include "film/image.hpp"

namespace phasetree::tracer {

/// A plane, once its contract has been asked of it. If it does not meet that, the message names the kind and the
/// member.
template <class Kind>
struct CheckedPlane {
    static_assert(PlaneKind<Kind>);
    using Type = Kind;
};

/// The first plane is the picture, which has three channels and which all formats can hold; the others become further
/// channels of the image.
template <class Picture, class... Others>
struct PlaneList {
    static_assert(CheckedPlane<Picture>::Type::channels.size() == 3);

    /// What is accumulated at one pixel.
    using Sums = std::tuple<typename Picture::Sum, typename CheckedPlane<Others>::Type::Sum...>;

    static void add(Sums& sums, const FilmSample& sample) {
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            Picture::add(std::get<0>(sums), sample);
            (Others::add(std::get<I + 1>(sums), sample), ...);
        }
        (std::index_sequence_for<Others...>());
    }

    /// A black image of so many pixels, with all channels.
    static Image image(int width, int height) {
        Image image;
        image.width = width;
        image.height = height;
        image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        [[maybe_unused]] const auto add_channels = [&](const auto& names) {
            for (const std::string_view name : names)
                image.further.push_back({std::string(name), std::vector<float>(image.pixels.size())});
        };
        (add_channels(Others::channels), ...);
        return image;
    }

    /// Writes a pixel's values into an image that was made by image(); `samples` is at least 1.
    static void resolve(const Sums& sums, int samples, Image& image, std::size_t pixel) {
        const auto [r, g, b] = Picture::resolve(std::get<0>(sums), samples);
        image.pixels[pixel] = {r, g, b};
        [[maybe_unused]] std::size_t channel = 0;
        [[maybe_unused]] const auto write = [&](const auto& values) {
            for (const float value : values) image.further[channel++].values[pixel] = value;
        };
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            (write(Others::resolve(std::get<I + 1>(sums), samples)), ...);
        }
        (std::index_sequence_for<Others...>());
    }
};

}  // namespace phasetree::tracer
