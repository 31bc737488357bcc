// Image files, as an environment, as a height map and as layers of numbers and of labels, by the path tracer's own
// reading of them. They are small: what a large one costs is no finding.
#include <OpenImageIO/imageio.h>

#include <array>

#include "fuzz/input_file.hpp"
#include "fuzz/walked_density.hpp"
#include "lights/load_environment.hpp"
#include "scene/read_parts.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::fuzz {

namespace {

// The extension that a file of such a beginning has.
std::size_t kind_of(std::string_view text) {
    if (text.starts_with("\x89PNG")) return 0;
    if (text.starts_with("\xff\xd8")) return 1;
    if (text.starts_with("\x76\x2f\x31\x01")) return 2;
    if (text.starts_with("#?")) return 3;
    return 4;
}

bool is_small(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) {
        (void)OIIO::geterror();
        return true;
    }
    const OIIO::ImageSpec& s = input->spec();
    constexpr std::int64_t most = 1 << 18;
    const auto is_within = [&](std::int64_t width, std::int64_t height) {
        return width <= most && height <= most && width * height * s.nchannels <= most;
    };
    return is_within(s.width, s.height) && is_within(s.full_width, s.full_height);
}

}  // namespace

void run_image(Bytes input) {
    static std::array<InputFile, 5> files{InputFile("i.png"), InputFile("i.jpg"), InputFile("i.exr"),
                                          InputFile("i.hdr"), InputFile("i.tif")};
    const std::filesystem::path& path = files[kind_of(text_of(input))].write(input);
    if (!is_small(path)) return;
    try {
        const tracer::ImageEnvironment light = tracer::load_environment(path.string(), 30, 2);
        for (const glm::vec2 u : {glm::vec2(0), glm::vec2(0.3f, 0.7f), glm::vec2(0.9999999f)})
            if (const auto sample = light.sample(u)) (void)light.pdf(sample->direction);
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {
    }
    try {
        const HeightGrid grid = tracer::read_height_grid(path);
        promised(grid.values.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                 "a height map has a value for each pixel");
    } catch (const std::runtime_error&) {
    }
    try {
        walk_density(tracer::read_number_stack(path, glm::dvec3(1)));
    } catch (const std::runtime_error&) {
    }
    try {
        const LabelGrid labels = tracer::read_label_grid(path, "");
        for (const std::uint8_t v : labels.voxels) promised(v < labels.numbers.size(), "a label is one of the list");
    } catch (const std::runtime_error&) {
    }
}

}  // namespace phasetree::fuzz
