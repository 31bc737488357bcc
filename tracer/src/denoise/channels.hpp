// Access to the channels of an image for denoising.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "denoise/denoise.hpp"

namespace phasetree::tracer {

/// The values of a further channel. Throws DenoiseError if it is missing.
inline std::span<const float> channel_of(const Image& image, std::string_view name) {
    const auto found = std::ranges::find(image.extra_channels, name, &Channel::name);
    if (found == image.extra_channels.end())
        throw DenoiseError(fmt::format("denoising needs the channel {}, which the film does not have", name));
    return found->values;
}

}  // namespace phasetree::tracer
