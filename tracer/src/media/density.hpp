// The list of all kinds of density, and one of any kind by value.
#pragma once

#include <variant>

#include "media/field_density.hpp"
#include "media/voxel_density.hpp"

namespace phasetree::tracer {

template <DensityKind... Kinds>
using DensityOf = std::variant<Kinds...>;

using Density = DensityOf<FieldDensity, VoxelDensity>;

/// ρ at eight points, of a density of any kind.
inline BatchOfFloats density_at(const Density& density, const PointBatch& points) {
    return std::visit([&](const auto& kind) { return kind.at(points, batch_size); }, density);
}
/// DensityKind's bounds() for a density of any kind.
inline const Bounds& bounds_of(const Density& density) {
    return std::visit([](const auto& kind) -> const Bounds& { return kind.bounds(); }, density);
}

/// The memory in bytes of a density's voxels.
inline std::size_t bytes_of(const Density& density) {
    const auto* voxels = std::get_if<VoxelDensity>(&density);
    return voxels ? voxels->bytes() : 0;
}

}  // namespace phasetree::tracer
