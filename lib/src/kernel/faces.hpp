#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/kernel.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::kernel {

/// Eight triangles, one per lane: at[3c + k] is coordinate k of their corners c. If there are fewer, the last is
/// repeated.
struct FaceBatch {
    alignas(32) float at[9][batch_size];
};
/// The largest number of triangles of a cell.
inline constexpr std::size_t most_faces = 64;

/// Where a line crosses a triangle.
struct FaceHit {
    double t;  ///< the distance along the ray, which may be negative
    std::uint32_t face;
    bool is_front;  ///< whether the ray arrives from the side on which the corners are counterclockwise
};

/// Finds all crossings of a ray's line with triangles, in any order; returns their number. There is room for one hit
/// per lane.
using MeetFaces = std::size_t (*)(const FaceBatch*, std::size_t batches, const TracedRay&, FaceHit*);

/// The function for the instruction set of a kernel. All of them give the same hits, to the last bit.
MeetFaces meet_faces_for(const Kernel&);

}  // namespace phasetree::kernel
