#include <stdexcept>

#include "image/read_image.hpp"
#include "scene/read_parts.hpp"
#include "text/read_text.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tracer {

HeightGrid read_height_grid(const std::filesystem::path& path) {
    HeightGrid grid;
    const auto begin = [&](const ImageHeader& header) {
        if (header.width < 2 || header.height < 2) throw std::runtime_error("it must have at least 2 × 2 pixels");
        if (header.width > 4096 || header.height > 4096) throw std::runtime_error("it is larger than 4096 × 4096");
        grid = {header.width, header.height, {}};
        return 1;
    };
    read_image(path, "height map", begin, [&](std::span<const float> values) {
        grid.values.insert(grid.values.end(), values.begin(), values.end());
    });
    return grid;
}

FileReaders file_readers() {
    return {.height_grid = read_height_grid,
            .level_set = read_level_set,
            .label_grid = read_label_grid,
            .label_files = layers_of_stack,
            .text_outlines = read_text};
}

}  // namespace phasetree::tracer
