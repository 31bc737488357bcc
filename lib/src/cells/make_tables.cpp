#include "cells/make_tables.hpp"

#include <algorithm>

#include "phasetree/building/options.hpp"

namespace phasetree::cells {

using building::CellBuffers, building::FaceCorners, building::narrow;

namespace {

void add_cells(const CellBuffer& buffer, const CurvatureCode& code, RoutineBuilder& routines, CellTables& tables) {
    for (const CellBuffer::Cell& c : buffer.cells) {
        const RoutineBuilder::BuiltRoutine& r = routines.add(buffer, c);
        // The linear bound describes the first component, so it only helps rays that evaluate this component alone.
        const bool is_bound_of_use = c.outputs == 2 || routines.tables.shapes[r.shape].first_component_steps > 0;
        tables.cells.push_back({c.box, is_bound_of_use ? c.bound : LinearBound{}, r.shape, r.first_data,
                                code.encode(c.curvature.bound[0]), code.encode(c.curvature.bound[1]),
                                buffer.outputs_of(c)[0].phase.index, c.curvature.uses_own_component,
                                c.curvature.first_component_decides});
        tables.first_certificate.push_back(narrow(tables.certificates.size()));
        routines.pack_certificate(r, buffer.certificate_of(c), tables.certificates);
    }
}

// Adds the faces of a buffer's cells. These cells must be the last ones in the table.
void add_faces(const CellBuffer& buffer, CellTables& tables) {
    if (buffer.cell_faces.empty()) return;
    const std::size_t before = tables.cells.size() - buffer.cells.size();
    for (const CellBuffer::CellFaces& of_cell : buffer.cell_faces) {
        tables.first_faces.resize(before + of_cell.cell + 1, narrow(tables.faces.size()));
        const std::span<const FaceCorners> corners = buffer.faces_of(of_cell);
        for (std::size_t i = 0; i < corners.size(); i += batch_size) {
            FaceBatch batch;
            for (std::size_t lane = 0; lane < batch_size; ++lane) {
                const FaceCorners& face = corners[std::min(i + lane, corners.size() - 1)];
                for (std::size_t k = 0; k < 9; ++k) batch.at[k][lane] = face.corner[k / 3][static_cast<int>(k % 3)];
            }
            tables.faces.push_back(batch);
        }
    }
}

}  // namespace

CellTables make_tables(CellBuffers found, std::vector<float>& constants, const CurvatureCode& code,
                       const std::function<bool()>& cancelled) {
    CellTables tables;
    RoutineBuilder routines(constants);
    tables.cells.reserve(found.cells());
    tables.first_certificate.reserve(found.cells() + 1);
    // Most of what is appended are the data of specialised instructions (rewriting/specialise.hpp). Reserve now: a
    // growing vector holds its contents twice for a while.
    std::size_t more = 0;
    for (const CellBuffer& buffer : found) more += buffer.specialised_data.size();
    constants.reserve(constants.size() + more);
    for (CellBuffer& buffer : found) {
        if (cancelled && cancelled()) throw BuildCancelled();
        routines.intern_specialised_data(buffer);
        add_cells(buffer, code, routines, tables);
        add_faces(buffer, tables);
    }
    if (!tables.faces.empty()) tables.first_faces.resize(tables.cells.size() + 1, narrow(tables.faces.size()));
    tables.faces.shrink_to_fit();
    tables.first_faces.shrink_to_fit();
    tables.first_certificate.push_back(narrow(tables.certificates.size()));
    tables.certificates.shrink_to_fit();
    tables.routine_count = routines.count();
    tables.routines = std::move(routines.tables);
    tables.routines.shrink_to_fit();
    return tables;
}

}  // namespace phasetree::cells
