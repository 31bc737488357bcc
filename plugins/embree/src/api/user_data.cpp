// The application's data attached to a geometry, which the library never uses.

#include "api/geometry_data.hpp"

namespace phasetree::embree::api {

namespace {

GeometryData::PhaseUserData& of_phase(GeometryData& data, unsigned phase) {
    if (phase >= data.of_phase.size()) throw invalid("phase is {}; phases are 0 … {}", phase, data.of_phase.size() - 1);
    return data.of_phase[phase];
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeSetGeometryUserData(PhasetreeGeometry geometry, void* user_pointer) {
    return guarded_call(__func__, [&] { api::data_of(geometry).user_pointer = user_pointer; });
}

PhasetreeError phasetreeGetGeometryUserData(PhasetreeGeometry geometry, void** user_pointer) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(user_pointer, "userPtr");
        *user_pointer = data.user_pointer;
    });
}

PhasetreeError phasetreeSetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase, int64_t user_integer,
                                                 void* user_pointer) {
    return guarded_call(__func__, [&] { of_phase(api::data_of(geometry), phase) = {user_integer, user_pointer}; });
}

PhasetreeError phasetreeGetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase, int64_t* user_integer,
                                                 void** user_pointer) {
    return guarded_call(__func__, [&] {
        const GeometryData::PhaseUserData& mine = of_phase(api::data_of(geometry), phase);
        if (user_integer) *user_integer = mine.integer;
        if (user_pointer) *user_pointer = mine.pointer;
    });
}
