#include "cells/data.hpp"

#include <algorithm>

#include "phasetree/trace/tracer.hpp"

namespace phasetree {

using cells::CurvatureCode;

namespace {

// The memory limit, capped at 64 GiB: cell indices have 32 bits, which is enough for the cells that fit there.
std::size_t limit_bytes(const CellOptions& options) {
    constexpr std::size_t largest = std::size_t{64} << 30;
    return std::min(options.max_bytes > 0 ? options.max_bytes : default_cell_bytes(), largest);
}

}  // namespace

InterfaceCells::Data::Data(const Phased& object, const CellOptions& options) {
    const TraceableObject traceable = prepare_to_trace(object, options.resolution);
    bounds = traceable.bounds;
    resolution = traceable.resolution;
    warning = traceable.warning;
    reach = 4 * resolution;
    opaque = options.opaque;
    max_depth = options.max_depth;
    quality = options.quality;
    max_bytes = limit_bytes(options);
    curvature_code = CurvatureCode(bounds.diagonal());
}

}  // namespace phasetree
