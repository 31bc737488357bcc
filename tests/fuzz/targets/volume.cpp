// OpenVDB files, by the readers of the nodes `volume` and `labels` and of numbers at voxels: what is read is sound, and
// everything else is rejected without more memory than a small file may take.
#include <cmath>
#include <stdexcept>

#include "fuzz/input_file.hpp"
#include "fuzz/walked_density.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::fuzz {

void run_volume(Bytes input) {
    static InputFile file("volume.vdb");
    const std::filesystem::path& path = file.write(input);
    try {
        const VoxelGrid grid = tracer::read_level_set(path, "");
        const Bounds box = grid.extent();
        for (const float share : {-0.5f, 0.25f, 0.5f, 2.f}) {
            const glm::vec3 at = box.low + share * box.extent();
            const float value = voxels::linear_at(grid.table.data(), Vec3<float>{at.x, at.y, at.z});
            promised(std::isfinite(value), "a volume has a value everywhere");
        }
    } catch (const std::runtime_error&) {
    }
    try {
        const VoxelGrid numbers = tracer::read_number_grid(path, "").grid;
        const Bounds box = numbers.extent();
        const glm::vec3 at = box.low + 0.3f * box.extent();
        promised(voxels::linear_at(numbers.table.data(), Vec3<float>{at.x, at.y, at.z}) >= 0.0f,
                 "numbers are not below 0");
        walk_density(numbers);
    } catch (const std::runtime_error&) {
    }
    try {
        const LabelGrid labels = tracer::read_label_grid(path, "");
        for (const std::uint8_t v : labels.voxels) promised(v < labels.numbers.size(), "a label is one of the list");
    } catch (const std::runtime_error&) {
    }
}

}  // namespace phasetree::fuzz
