#include "rays/race_with_mesh.hpp"

#include "rays/beside_mesh.hpp"

namespace phasetree::bench {

std::vector<Column> RaceWithMesh::columns() {
    return {{"primary_rays_per_second", "primary M/s", "{:.2f}", 1e-6},
            {"random_rays_per_second", "random M/s", "{:.2f}", 1e-6},
            {"primary_ratio", "primary ×", "{:.2f}"},
            {"random_ratio", "random ×", "{:.2f}"}};
}

std::vector<Table::Cell> RaceWithMesh::speeds(Runner runner) const {
    const auto rate = [&](const Turns& turns) {
        return static_cast<double>(turns.checksum(runner).rays) / turns.seconds(runner).median;
    };
    return {rate(on_primary), rate(on_random), on_primary.ratio(triangles, runner), on_random.ratio(triangles, runner)};
}

RaceWithMesh race(const FieldScene& field, const MeshScene& triangles, const Rays& camera, const Settings& settings) {
    const SurfaceRays random = leaving(field, triangles, camera, settings.seed);
    const auto in_both = [&](const Rays& of_field, const Rays& of_mesh) {
        return in_turn({{"triangles", [&] { return triangles.trace(of_mesh, settings.threads); }},
                        {"field", [&] { return field.trace(of_field, settings.threads); }}},
                       settings.timing());
    };
    return {in_both(camera, camera), in_both(random.of_field, random.of_mesh)};
}

}  // namespace phasetree::bench
