// Statistics of a built geometry.

#include "api/geometry_data.hpp"

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeGetGeometryStatistics(PhasetreeGeometry geometry, PhasetreeGeometryStatistics* statistics) {
    return guarded_call(__func__, [&] {
        const InterfaceCells& cells = api::data_of(geometry).object->cells();
        require(statistics, "statistics");
        const CellStatistics s = cells.statistics();
        *statistics = {s.cells,
                       s.bytes,
                       cells.whole().program().instructions.size(),
                       s.median_instructions,
                       s.max_instructions,
                       cells.resolution(),
                       static_cast<float>(s.build_seconds)};
    });
}

PhasetreeError phasetreeGetGeometryWarning(PhasetreeGeometry geometry, const char** warning) {
    return guarded_call(__func__, [&] {
        const InterfaceCells& cells = api::data_of(geometry).object->cells();
        require(warning, "warning");
        *warning = cells.warning().c_str();
    });
}
