// One to a million instances of an object, as a field and as triangles: the cost of an instance, and of rays through
// instances.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/quaternion.hpp>

#include "commands/commands.hpp"
#include "measure/resident.hpp"
#include "mesh/surface_nets.hpp"
#include "objects/scene_file.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random.hpp"
#include "trace/field_scene.hpp"
#include "trace/instanced_mesh.hpp"
#include "world/traced_geometry.hpp"

namespace phasetree::bench {

namespace {

constexpr int cubes = 256;  // along the mesh's longest side
const char* const object_file = PHASETREE_SCENES "/benchmark/hourglass_monophase.json";

// Transforms on a cubic lattice, spaced by the size of the object, each with a random rotation.
std::vector<glm::mat4x3> places(int along, const Bounds& object, std::uint64_t seed) {
    Random random(seed);
    std::vector<glm::mat4x3> result;
    for (int z = 0; z < along; ++z)
        for (int y = 0; y < along; ++y)
            for (int x = 0; x < along; ++x) {
                const glm::vec3 axis = random.direction();
                const glm::mat3 turn = glm::mat3_cast(glm::angleAxis(6.2831853f * random.next(), axis));
                const glm::vec3 at = object.diagonal() * glm::vec3(x, y, z) - turn * object.centre();
                result.emplace_back(turn[0], turn[1], turn[2], at);
            }
    return result;
}

// The instances as a file that a scene can refer to. The file exists as long as this object.
class PlacesFile {
  public:
    explicit PlacesFile(std::span<const glm::mat4x3> places)
        : path_(std::filesystem::temp_directory_path() / fmt::format("phasetree-bench-{}.places", places.size())) {
        std::ofstream out(path_, std::ios::binary);
        const std::uint64_t count = places.size();
        out.write("PTPLACES", 8).write(reinterpret_cast<const char*>(&count), sizeof count);
        out.write(reinterpret_cast<const char*>(places.data()), static_cast<std::streamsize>(places.size_bytes()));
        if (!out.flush()) throw std::runtime_error(path_.string() + " cannot be written");
    }
    ~PlacesFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    PlacesFile(const PlacesFile&) = delete;
    PlacesFile& operator=(const PlacesFile&) = delete;
    std::string path() const { return path_.string(); }

  private:
    std::filesystem::path path_;
};

tracer::Scene scene_of(std::span<const glm::mat4x3> places) {
    const PlacesFile file(places);
    return tracer::read_scene(Document::from_text(
        fmt::format(
            R"({{"version": 1, "phases": {{"clay": {{"diffuse": {{"color": [0.5, 0.5, 0.5]}}}}}}, "objects": [{{"name": "object", "file": "{}"}}],
                        "instances": [{{"of": "object", "file": "{}"}}], "lights": [],
                        "camera": {{"position": [0, -1, 0], "look_at": [0, 0, 0]}}}})",
            object_file, file.path()),
        "instances.json"));
}

// The instances as the path tracer has them: each hit has its normal, and everything else that a path needs.
class PlacedObjects {
  public:
    explicit PlacedObjects(std::span<const glm::mat4x3> places) : scene_(scene_of(places)), geometry_(scene_) {}
    std::optional<tracer::Surface> intersect(const tracer::Ray& ray) const {
        tracer::PathCounters counters;
        const tracer::Hit hit = geometry_.intersect(ray, counters);
        if (const auto* surface = std::get_if<tracer::Surface>(&hit)) return *surface;
        return std::nullopt;
    }
    const Bounds& bounds() const { return geometry_.bounds(); }

  private:
    tracer::Scene scene_;
    tracer::TracedGeometry geometry_;
};

// The same rays for both. Rays that leave a surface start at the hit of the respective surface.
struct RaysOfBoth {
    Rays mesh;
    std::vector<tracer::Ray> field;
};

tracer::Ray as_traced(const Ray& ray) {
    return {ray.origin, ray.direction};
}

RaysOfBoth leaving(const PlacedObjects& field, const InstancedMesh& mesh, const Rays& camera, float hair,
                   std::uint64_t seed) {
    const FlushSubnormals flush;
    Random random(seed);
    RaysOfBoth rays;
    for (const Ray& ray : camera) {
        const auto f = field.intersect(as_traced(ray));
        const auto m = mesh.intersect(ray);
        if (!f || !m || std::abs(f->distance - m->distance) > 300 * hair) continue;
        glm::vec3 flat = glm::normalize(m->normal);
        if (glm::dot(flat, ray.direction) > 0) flat = -flat;
        glm::vec3 direction = random.direction();
        if (glm::dot(direction, flat) < 0) direction = -direction;
        if (!(glm::dot(direction, f->normal) > 0)) continue;
        rays.field.push_back(f->reflected(direction));
        rays.mesh.push_back({ray.origin + m->distance * ray.direction + hair * flat, direction, {}});
    }
    return rays;
}

Turns contest(const PlacedObjects& field, const InstancedMesh& mesh, const RaysOfBoth& rays, const Settings& settings) {
    const auto of_mesh = [&](const Ray& ray) -> std::optional<float> {
        const auto hit = mesh.intersect(ray);
        if (!hit) return std::nullopt;
        return hit->distance;
    };
    const auto of_field = [&](const Ray& ray) -> std::optional<float> {
        const auto hit = field.intersect(rays.field[static_cast<std::size_t>(&ray - rays.mesh.data())]);
        if (!hit) return std::nullopt;
        return hit->distance;
    };
    return in_turn({{"triangles", [&] { return trace_many(rays.mesh, settings.threads, of_mesh); }},
                    {"field", [&] { return trace_many(rays.mesh, settings.threads, of_field); }}},
                   settings.timing());
}

template <class Make>
auto measured(Make&& make, double& taken, double& megabytes) {
    const double before = resident_megabytes(), start = seconds(Clock::wall);
    auto made = make();
    taken = seconds(Clock::wall) - start;
    megabytes = resident_megabytes() - before;
    return made;
}

}  // namespace

Report instances(const Settings& settings) {
    Report report("instances", "instances of an object, as a field and as triangles");
    report.say(
        fmt::format("the outer surface of an hourglass, and its triangles (surface nets of {}³ cubes) as Embree "
                    "instances, not robust; on a lattice, rotated at random",
                    cubes));
    report.say(
        fmt::format("rays: {}×{} camera rays, one per pixel, and one random ray from each hit; {} thread(s); hits "
                    "include the normal, those of the field everything that a path needs",
                    settings.width, settings.height, settings.threads));
    report.say("build: from the list of instances, on all cores, wall-clock time");
    Table table({{"copies", "copies", "{:.0f}"},
                 {"what", "", ""},
                 {"build_seconds", "build s", "{:.2f}"},
                 {"primary_rays_per_second", "primary M/s", "{:.2f}", 1e-6},
                 {"random_rays_per_second", "random M/s", "{:.2f}", 1e-6},
                 {"primary_ratio", "primary ×", "{:.2f}"},
                 {"random_ratio", "random ×", "{:.2f}"}});
    const FieldScene single(scene_file("benchmark/hourglass_monophase").object, PhaseSet{0b10});
    const Triangles triangles = surface_nets(single, cubes);
    const Bounds& bounds = single.cells().bounds();
    const glm::vec3 extent = bounds.extent();
    const double cube = static_cast<double>(std::max({extent.x, extent.y, extent.z})) / cubes;
    std::vector<std::vector<Table::Cell>> rows;
    // The largest number comes first, because memory that was freed would hide new allocations.
    for (const int along : {100, 32, 10, 1}) {
        if (settings.quick && along > 32) continue;
        const auto where = places(along, bounds, settings.seed);
        const double count = static_cast<double>(where.size());
        double field_seconds = 0, field_megabytes = 0, mesh_seconds = 0, mesh_megabytes = 0;
        const auto field =
            measured([&] { return std::make_unique<PlacedObjects>(where); }, field_seconds, field_megabytes);
        const auto mesh =
            measured([&] { return std::make_unique<InstancedMesh>(triangles, where); }, mesh_seconds, mesh_megabytes);
        RaysOfBoth primary{camera_rays(camera_for(field->bounds()), settings.width, settings.height), {}};
        std::ranges::transform(primary.mesh, std::back_inserter(primary.field), as_traced);
        const RaysOfBoth random = leaving(*field, *mesh, primary.mesh, 1e-5f * bounds.diagonal(), settings.seed);
        std::size_t both = 0, either = 0;
        double apart = 0;
        for (std::size_t i = 0; i < primary.mesh.size(); ++i) {
            const auto f = field->intersect(primary.field[i]);
            const auto m = mesh->intersect(primary.mesh[i]);
            either += f || m ? 1 : 0;
            if (!f || !m) continue;
            ++both;
            apart += std::min(std::abs(static_cast<double>(f->distance - m->distance)), 10 * cube);
        }
        report.check(
            fmt::format("{:.0f} copies: field and triangles are the same surfaces", count),
            static_cast<double>(both) > 0.95 * static_cast<double>(either) && apart < static_cast<double>(both) * cube,
            fmt::format("{:.2f} % of rays hit both, {:.3f} cubes apart on average (at most 10)",
                        100 * static_cast<double>(both) / static_cast<double>(either),
                        apart / static_cast<double>(both) / cube));
        const Turns on_primary = contest(*field, *mesh, primary, settings);
        const Turns on_random = contest(*field, *mesh, random, settings);
        if (rows.empty())
            report.say(fmt::format("memory of {:.0f} copies: {:.0f} MB as fields, {:.0f} MB as triangles", count,
                                   field_megabytes, mesh_megabytes));
        const auto row = [&](std::size_t i, const std::string& what, double build) {
            const auto rate = [&](const Turns& turns) {
                return static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median;
            };
            rows.push_back(
                {count, what, build, rate(on_primary), rate(on_random), on_primary.ratio(0, i), on_random.ratio(0, i)});
        };
        row(1, "field", field_seconds);
        row(0, fmt::format("{} triangles", triangles.triangles.size()), mesh_seconds);
    }
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) table.row(std::move(*row));
    report.table("copies", table);
    return report;
}

}  // namespace phasetree::bench
