#include "volume/read_volume.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "volume/formats.hpp"

namespace phasetree::tracer {

namespace {

template <class Read>
auto named(const std::filesystem::path& path, std::string_view what, Read&& read) {
    try {
        return read();
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(fmt::format("cannot use the {} \"{}\": {}", what, path.string(), e.what()));
    }
}

}  // namespace

bool has_ending_of_openvdb(const std::filesystem::path& path) {
    return path.extension() == ".vdb";
}

VoxelGrid read_level_set(const std::filesystem::path& path, const std::string& grid) {
    return named(path, "volume", [&] {
        if (!has_ending_of_openvdb(path)) throw std::runtime_error("its name must end in .vdb");
        VoxelGrid found = level_set_of_openvdb(path, grid);
        const double steepest = found.steepest_linear();
        if (steepest > 1e4)
            throw std::runtime_error(fmt::format(
                "its values change by up to {:.3g} m per metre, so it is not a level set, whose values are distances",
                steepest));
        if (steepest > 1) found.divide_by(steepest * (1 + 1e-6));
        return found;
    });
}

LabelGrid read_label_grid(const std::filesystem::path& path, const std::string& grid) {
    return named(path, "labels", [&] {
        if (has_ending_of_openvdb(path)) return labels_of_openvdb(path, grid);
        if (!grid.empty()) throw std::runtime_error("images have no named grids; remove \"grid\"");
        return labels_of_images(path);
    });
}

PlacedVoxels read_number_grid(const std::filesystem::path& path, const std::string& grid) {
    return named(path, "voxels", [&] { return numbers_of_openvdb(path, grid); });
}

VoxelGrid read_number_stack(const std::filesystem::path& path, const glm::dvec3& spacing) {
    return named(path, "voxels", [&] { return numbers_of_images(path, spacing); });
}

}  // namespace phasetree::tracer
