#include "output/encode.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>

#include "output/error.hpp"
#include "output/quantise.hpp"
#include "phasetree/version.hpp"

namespace phasetree::tracer {
namespace {

// CIE xy of red, green, blue and white: ITU-R BT.709 and D65.
constexpr std::array<float, 8> rec709_chromaticities{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Any name with the right extension; no such file is opened.
const char* name_for_format(Format format) {
    switch (format) {
        case Format::exr:
            return "image.exr";
        case Format::png:
            return "image.png";
        case Format::jpeg:
            return "image.jpg";
        case Format::tiff:
            return "image.tif";
    }
    throw std::invalid_argument("unknown image format");
}

void check(const Image& image) {
    if (image.width <= 0 || image.height <= 0 ||
        image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
        throw std::invalid_argument("an image must have width × height pixels, and at least one");
    }
    for (const Channel& channel : image.extra_channels)
        if (channel.values.size() != image.pixels.size())
            throw std::invalid_argument("a channel must have a value for each pixel of its image");
    if (const auto& crop = image.crop;
        crop && (crop->x0 < 0 || crop->y0 < 0 || crop->display_width < image.width ||
                 crop->x0 > crop->display_width - image.width || crop->display_height < image.height ||
                 crop->y0 > crop->display_height - image.height)) {
        throw std::invalid_argument("a crop must lie inside its picture");
    }
}

// Metadata common to all formats.
OIIO::ImageSpec common_spec(const Image& image, OIIO::TypeDesc type, const std::string& build) {
    OIIO::ImageSpec spec(image.width, image.height, 3, type);
    spec.attribute("Software", fmt::format("phasetree {}", build));
    // If omitted, EXR and TIFF use the current date. An empty date makes equal pictures equal files.
    spec.attribute("DateTime", "");
    return spec;
}

std::string scene_name(const Metadata& metadata) {
    return std::filesystem::path(metadata.scene).filename().string();
}

OIIO::ImageSpec exr_spec(const Image& image, const Layer& layer, const Metadata& metadata) {
    OIIO::ImageSpec spec = common_spec(image, OIIO::TypeDesc::FLOAT, metadata.build);
    if (image.crop) {
        spec.x = image.crop->x0;
        spec.y = image.crop->y0;
        spec.full_width = image.crop->display_width;
        spec.full_height = image.crop->display_height;
    }
    if (!layer.has_picture) spec.channelnames.clear();
    for (const Channel* channel : layer.channels) spec.channelnames.push_back(channel->name);
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    for (const auto& [name, text] : layer.attributes) spec.attribute(name, text);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709_chromaticities.data());
    spec.attribute("phasetree:scene", scene_name(metadata));
    spec.attribute("phasetree:samplesPerPixel", metadata.samples_per_pixel);
    spec.attribute("phasetree:seed", std::to_string(metadata.seed));
    return spec;
}

// The specification of a file with display values.
OIIO::ImageSpec shown_spec(const Image& image, Format format, const Metadata& metadata,
                           const DisplayTransform& transform) {
    OIIO::ImageSpec spec =
        common_spec(image, format == Format::tiff ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8, metadata.build);
    spec.attribute("ImageDescription",
                   fmt::format("{}, {} samples per pixel, seed {}, {} {:+g} EV", scene_name(metadata),
                               metadata.samples_per_pixel, metadata.seed, transform.view(), transform.exposure_ev()));
    // Not in TIFF, where it would become an EXIF directory, which OpenImageIO before 2.5.13 corrupts when writing to
    // memory.
    if (transform.is_srgb() && format != Format::tiff) spec.attribute("oiio:ColorSpace", "sRGB");
    if (format == Format::jpeg) {
        spec.attribute("compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    } else if (format == Format::tiff) {
        spec.attribute("compression", "zip");
    }
    return spec;
}

std::vector<unsigned char> encoded(const OIIO::ImageSpec& spec, const char* name, const void* pixels) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) throw OutputError(fmt::format("OpenImageIO cannot write this format: {}", OIIO::geterror()));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->supports("ioproxy"))
        throw OutputError("this version of OpenImageIO is too old; 2.4 or newer is required");
    output->set_ioproxy(&memory);
    if (!output->open(name, spec) || !output->write_image(spec.format, pixels) || !output->close()) {
        throw OutputError(output->geterror());
    }
    return bytes;
}

// The coverage of each pixel, if it is recorded and the background is black: pixels without coverage then have no
// light, except for a little that denoising may leave. Over another background, the colour of the covering surface is
// unknown.
const Channel* alpha_of(const Image& image) {
    const auto found = std::ranges::find(image.extra_channels, "A", &Channel::name);
    if (found == image.extra_channels.end()) return nullptr;
    double covered = 0, uncovered = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& p = image.pixels[i];
        const double light = static_cast<double>(std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
        if (std::isfinite(light)) (found->values[i] > 0 ? covered : uncovered) += light;
    }
    return uncovered <= 0.001 * covered ? &*found : nullptr;
}

// PNG files and image editors use unpremultiplied colours.
void divide_by_alpha(std::vector<glm::vec3>& pixels, const Channel& alpha) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float covered = alpha.values[i];
        pixels[i] = covered > 0.0f ? pixels[i] / covered : glm::vec3(0.0f);
    }
}

// Converts a channel to pixels with three equal values.
std::vector<glm::vec3> spread(const Channel& channel) {
    std::vector<glm::vec3> pixels;
    pixels.reserve(channel.values.size());
    for (const float value : channel.values) pixels.emplace_back(value);
    return pixels;
}

// Combines codes of three colours, and of three equal alphas, into RGBA.
template <class Code>
std::vector<Code> with_alpha(const std::vector<Code>& colours, const std::vector<Code>& alphas) {
    std::vector<Code> codes;
    codes.reserve(colours.size() / 3 * 4);
    for (std::size_t i = 0; i < colours.size(); i += 3)
        codes.insert(codes.end(), {colours[i], colours[i + 1], colours[i + 2], alphas[i]});
    return codes;
}

// All channels of a layer, interleaved by pixel.
std::vector<float> interleaved(const Image& image, const Layer& layer) {
    std::vector<float> values;
    values.reserve(image.pixels.size() * ((layer.has_picture ? 3 : 0) + layer.channels.size()));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3& colour = image.pixels[i];
        if (layer.has_picture) values.insert(values.end(), {colour.r, colour.g, colour.b});
        for (const Channel* channel : layer.channels) values.push_back(channel->values[i]);
    }
    return values;
}

}  // namespace

Format format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") return Format::exr;
    if (extension == ".png") return Format::png;
    if (extension == ".jpg" || extension == ".jpeg") return Format::jpeg;
    if (extension == ".tif" || extension == ".tiff") return Format::tiff;
    throw OutputNameError(fmt::format(
        "cannot write \"{}\": {}; use .exr, .png, .jpg, .jpeg, .tif or .tiff", path.string(),
        extension.empty() ? "its name has no extension" : fmt::format("unknown image format \"{}\"", extension)));
}

std::vector<unsigned char> encode(const Image& image, Format format, const Metadata& metadata,
                                  const DisplayTransform& transform) {
    if (format == Format::exr) return encode_layer(image, whole(image), metadata);
    check(image);
    const Channel* const alpha = format == Format::jpeg ? nullptr : alpha_of(image);
    std::vector<glm::vec3> shown = image.pixels;
    if (alpha) divide_by_alpha(shown, *alpha);
    transform.apply(shown);
    OIIO::ImageSpec spec = shown_spec(image, format, metadata, transform);
    if (alpha) {
        spec.nchannels = 4;
        spec.channelnames = {"R", "G", "B", "A"};
        spec.alpha_channel = 3;
        spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    const char* name = name_for_format(format);
    const Crop whole{};
    const Crop& place = image.crop ? *image.crop : whole;
    const auto codes_of = [&](const std::vector<glm::vec3>& pixels) {
        return quantise8(pixels, image.width, place.x0, place.y0);
    };
    if (format == Format::tiff) {
        const auto codes = quantise16(shown);
        return encoded(spec, name, alpha ? with_alpha(codes, quantise16(spread(*alpha))).data() : codes.data());
    }
    const auto codes = codes_of(shown);
    return encoded(spec, name, alpha ? with_alpha(codes, codes_of(spread(*alpha))).data() : codes.data());
}

std::vector<unsigned char> encode_png(std::span<const std::uint8_t> pixels, int width, int height,
                                      const std::string& description) {
    if (pixels.size() != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw std::invalid_argument("a picture must have width × height pixels");
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Software", fmt::format("phasetree {}", build_id()));
    spec.attribute("DateTime", "");
    spec.attribute("ImageDescription", description);
    return encoded(spec, name_for_format(Format::png), pixels.data());
}

std::vector<unsigned char> encode_layer(const Image& image, const Layer& layer, const Metadata& metadata) {
    check(image);
    const OIIO::ImageSpec spec = exr_spec(image, layer, metadata);
    const char* name = name_for_format(Format::exr);
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "pixels are handed to OpenImageIO as packed floats");
    if (layer.has_picture && layer.channels.empty()) return encoded(spec, name, image.pixels.data());
    return encoded(spec, name, interleaved(image, layer).data());
}

std::string openimageio_version() {
    const int version = OIIO::openimageio_version();  // 10000 × major + 100 × minor + patch
    return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace phasetree::tracer
