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
    const auto read_heights = [](const std::filesystem::path& path, const std::string&) {
        return read_height_grid(path);
    };
    return FileReaders()
        .add<HeightGrid>({.read = read_heights})
        .add<VoxelGrid>({.read = read_level_set})
        .add<LabelGrid>({.read = read_label_grid, .files = layers_of_stack})
        .add<TextOutlines>({.read = read_text});
}

}  // namespace phasetree::tracer
