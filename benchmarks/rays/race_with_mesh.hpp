// A field and the triangles that would replace it, timed in turn on the camera's rays and on random ones from what
// those hit.
#pragma once

#include <vector>

#include "measure/in_turn.hpp"
#include "measure/report.hpp"
#include "settings.hpp"
#include "trace/field_scene.hpp"
#include "trace/mesh_scene.hpp"

namespace phasetree::bench {

struct RaceWithMesh {
    enum Runner : std::size_t { triangles, field };
    Turns on_primary, on_random;

    // The columns of a table that speeds() fills: rays a second, and how many times as fast as the triangles.
    static std::vector<Column> columns();
    std::vector<Table::Cell> speeds(Runner) const;
};

RaceWithMesh race(const FieldScene& field, const MeshScene& triangles, const Rays& camera, const Settings& settings);

}  // namespace phasetree::bench
