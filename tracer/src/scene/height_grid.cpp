#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <stdexcept>

#include "scene/parts.hpp"

namespace phasetree::tracer {

HeightGrid read_height_grid(const std::filesystem::path& path) {
    const auto problem = [&](const std::string& what) {
        return std::runtime_error("cannot use the height map \"" + path.string() +
                                  "\": " + what.substr(0, what.find('\n')));
    };
    // The library's own messages for these two are long and speak of formats and plug-ins.
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw problem("there is no such file");
    if (!std::filesystem::is_regular_file(path, ignored)) throw problem("it is not a file");
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) throw problem(OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    if (spec.width < 2 || spec.height < 2 || spec.nchannels < 1) throw problem("it needs two pixels each way");
    if (spec.depth > 1) throw problem("it is a volume, not an image");
    if (spec.width > 4096 || spec.height > 4096) throw problem("it is larger than 4096 × 4096");
    HeightGrid grid{spec.width, spec.height, {}};
    grid.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, grid.values.data())) throw problem(input->geterror());
    return grid;
}

}  // namespace phasetree::tracer
