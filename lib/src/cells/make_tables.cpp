#include "cells/make_tables.hpp"

#include "phasetree/building/options.hpp"

namespace phasetree::cells {

using building::CellBuffers, building::narrow;

namespace {

void add_cells(const CellBuffer& buffer, const CurvatureCode& code, RoutineBuilder& routines, CellTables& tables) {
    for (const CellBuffer::Cell& c : buffer.cells) {
        const RoutineBuilder::BuiltRoutine& r = routines.add(buffer, c);
        // The linear bound describes the first component, so it only helps rays that evaluate this component alone.
        const bool is_bound_of_use = c.outputs == 2 || routines.tables.shapes[r.shape].leading > 0;
        tables.cells.push_back({c.box, is_bound_of_use ? c.bound : LinearBound{}, r.shape, r.first_data,
                                code.encode(c.curvature.bound[0]), code.encode(c.curvature.bound[1]),
                                buffer.outputs_of(c)[0].phase.index, c.curvature.is_by_own, c.curvature.is_by_first});
        tables.first_certificate.push_back(narrow(tables.certificates.size()));
        routines.pack_certificate(r, buffer.certificate_of(c), tables.certificates);
    }
}

}  // namespace

CellTables make_tables(CellBuffers found, std::vector<float>& constants, const CurvatureCode& code,
                       const std::function<bool()>& cancelled) {
    CellTables tables;
    RoutineBuilder routines(constants);
    tables.cells.reserve(found.cells());
    tables.first_certificate.reserve(found.cells() + 1);
    // At most, all data of specialised instructions are appended. Reserve now: a growing vector holds its contents
    // twice for a while.
    std::size_t more = 0;
    for (const CellBuffer& buffer : found) more += buffer.specialised_data.size();
    constants.reserve(constants.size() + more);
    for (CellBuffer& buffer : found) {
        if (cancelled && cancelled()) throw BuildCancelled();
        routines.intern_specialised_data(buffer);
        add_cells(buffer, code, routines, tables);
    }
    tables.first_certificate.push_back(narrow(tables.certificates.size()));
    tables.certificates.shrink_to_fit();
    tables.routine_count = routines.count();
    tables.routines = std::move(routines.tables);
    tables.routines.shrink_to_fit();
    return tables;
}

}  // namespace phasetree::cells
