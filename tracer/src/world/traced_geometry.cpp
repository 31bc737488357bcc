#include "world/traced_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>

#include "phasetree/cells/file.hpp"
#include "scene/meshes_alone.hpp"
#include "world/bumps_and_grain.hpp"
#include "world/kept_cells.hpp"
#include "world/mesh_place.hpp"
#include "world/triangle_hit.hpp"

namespace phasetree::tracer {

namespace {

Blocked blocked_by(const Surface& surface) {
    return {surface.distance, surface.emitted() ? std::optional(surface) : std::nullopt};
}

// The depth of division for a preview: such cells are built immediately, even for trees so slow that good cells take
// seconds.
constexpr int divisions_for_first_look = 5;

// The geometries of the Embree scene: the object, or the instances of several, then the meshes in order.
constexpr unsigned object_id = 0;
constexpr unsigned first_mesh_id = object_id + 1;

// The offset of rays that leave a mesh: this share of the object's diagonal, or of the point's largest coordinate (at
// least 1 m), whichever is greater.
constexpr float relative_surface_epsilon = 1e-5f;

std::vector<std::shared_ptr<const InterfaceCells>> prepared(const Scene& scene, const WorldOptions& wanted) {
    CellOptions options = cell_options(scene, wanted);
    if (scene.placed.empty() && wanted.known_cells && are_cells_of(*wanted.known_cells, scene.object, options))
        return {wanted.known_cells};
    if (scene.placed.empty())
        return {wanted.kept_cells ? kept_cells(*wanted.kept_cells, scene.object, options)
                                  : std::make_shared<const InterfaceCells>(scene.object, options)};
    const auto& objects = scene.placed.objects;
    const std::size_t max_bytes = wanted.max_bytes > 0 ? wanted.max_bytes : default_cell_bytes();
    options.max_bytes = std::max<std::size_t>(max_bytes / objects.size(), 1);
    std::vector<std::shared_ptr<const InterfaceCells>> cells;
    for (const PlacedObject& object : objects) {
        if (wanted.progress)
            options.progress = [&, before = static_cast<float>(cells.size())](float done) {
                wanted.progress((before + done) / static_cast<float>(objects.size()));
            };
        cells.push_back(std::make_shared<const InterfaceCells>(object.tree, options));
    }
    return cells;
}

DeviceHandle started_embree(const std::string& configuration) {
    DeviceHandle device(rtcNewDevice(configuration.c_str()));
    if (!device) throw std::runtime_error("cannot start Embree");
    return device;
}

std::vector<Interface> interfaces_of(std::span<const Mesh> meshes, std::span<const Material> phases,
                                     SharedSurfaces& shared) {
    std::vector<Interface> interfaces;
    interfaces.reserve(meshes.size() * phases.size());
    for (const Mesh& mesh : meshes)
        for (const Material& from : phases) interfaces.push_back(Interface::between(from, mesh.material, shared));
    return interfaces;
}

}  // namespace

CellOptions cell_options(const Scene& scene, const WorldOptions& wanted) {
    CellOptions options;
    options.quality = wanted.quality;
    if (wanted.is_first_look) {
        options.quality = BuildQuality::low;
        options.max_depth = divisions_for_first_look;
    }
    options.cancelled = wanted.cancelled;
    options.progress = wanted.progress;
    options.max_bytes = wanted.max_bytes;
    options.opaque = opaque_phases(scene.materials);
    return options;
}

TracedGeometry::TracedGeometry(const Scene& scene, const WorldOptions& options)
    : TracedGeometry(scene, options, options.surfaces ? options.surfaces : std::make_shared<SharedSurfaces>()) {}

TracedGeometry::TracedGeometry(const Scene& scene, const WorldOptions& options,
                               const std::shared_ptr<SharedSurfaces>& shared)
    : scene_(scene),
      cells_(prepared(scene, options)),
      device_(started_embree(options.embree_configuration)),
      embree_(rtcNewScene(device_.get())),
      first_mesh_(static_cast<std::uint32_t>(std::max<std::size_t>(scene.placed.objects.size(), 1))),
      interfaces_(scene.materials, *shared),
      mesh_interfaces_(interfaces_of(scene.meshes, scene.materials, *shared)) {
    // Without this flag, Embree may miss triangles hit near their edges.
    rtcSetSceneFlags(embree_.get(), RTC_SCENE_FLAG_ROBUST);
    if (scene.placed.empty()) {
        tree_.emplace(device_.get(), cells_.front(), embree::CellGeometry::Options{.rays_carry_phases = true});
        rtcCommitGeometry(tree_->handle());
    } else {
        placed_.emplace(device_.get(), scene.placed, cells_);
    }
    rtcAttachGeometryByID(embree_.get(), placed_ ? placed_->handle() : tree_->handle(), object_id);
    unsigned id = first_mesh_id;
    for (const Mesh& mesh : scene.meshes) {
        auto& moving = moving_meshes_.emplace_back();
        if (mesh.motion) moving = std::make_unique<const MovingMesh>(device_.get(), mesh, id);
        rtcAttachGeometryByID(embree_.get(), moving ? moving->handle() : triangles_of(device_.get(), mesh).get(), id);
        mesh_bounds_.push_back(moving ? moving->bounds() : bounds_of({&mesh, 1}));
        ++id;
    }
    rtcCommitScene(embree_.get());
    surface_epsilon_ = relative_surface_epsilon * bounds().diagonal();
}

RTCRayHit TracedGeometry::rayhit_of(const Ray& ray, float near, float far) {
    RTCRayHit rayhit = embree::rayhit_of(ray.origin, ray.direction, near, far);
    rayhit.ray.time = ray.in.time();
    return rayhit;
}

void TracedGeometry::find_closest_hit(embree::Query& query, RTCRayHit& rayhit) const {
    embree::intersect(embree_.get(), query.context, rayhit);
    auto& [ray, hit] = rayhit;
    if (!embree::is_hit(rayhit) || hit.geomID < first_mesh_id || hit.instID[0] != RTC_INVALID_GEOMETRY_ID) return;
    recompute_hit({embree_.get(), scene_.meshes, moving_meshes_, first_mesh_id}, ray, hit, ray.tfar);
}

// Traces the ray and returns whether it meets anything.
bool TracedGeometry::trace(const Ray& ray, float far, embree::Query& query, RTCRayHit& hit,
                           PathCounters& counters) const {
    query.default_phase = ray.phase;  // the scene has one object
    query.start = ray.hint;
    hit = rayhit_of(ray, 0, far);
    find_closest_hit(query, hit);
    if (query.is_out_of_memory) throw std::bad_alloc();
    ++counters.rays;
    counters.trace.visits += query.counters.visits;
    counters.trace.batches += query.counters.batches;
    counters.trace.phantoms += query.counters.phantoms;
    if (!embree::is_hit(hit)) return false;
    const Crossing& c = query.crossing;
    if (hit.hit.geomID == object_id)
        if (const auto mesh = mesh_flush_with_interface(ray, c.to, c.t_from, c.p_from, c.p_to)) hit = *mesh;
    return true;
}

std::optional<RTCRayHit> TracedGeometry::mesh_flush_with_interface(const Ray& ray, Phase to, float distance,
                                                                   const glm::vec3& p_from,
                                                                   const glm::vec3& p_to) const {
    if (mesh_bounds_.empty() || !is_clear(scene_.materials[to.index])) return std::nullopt;
    // The relative rounding error of Embree's distances, and of coordinates.
    constexpr float rounding = 4e-7f;
    const float largest = std::max({std::abs(p_from.x), std::abs(p_from.y), std::abs(p_from.z)});
    const float depth = glm::length(p_to - p_from) + rounding * (distance + largest);
    if (std::ranges::none_of(mesh_bounds_, [&](const Bounds& box) { return box.inflated(depth).contains(p_from); }))
        return std::nullopt;
    embree::Query query;
    query.skips_cells = true;
    RTCRayHit hit = rayhit_of(ray, distance, distance + depth);
    find_closest_hit(query, hit);
    return embree::is_hit(hit) ? std::optional(hit) : std::nullopt;
}

Hit TracedGeometry::intersect(const Ray& ray, PathCounters& counters) const {
    if (placed_) return intersect_several(ray, std::numeric_limits<float>::infinity(), counters);
    embree::Query query;
    RTCRayHit hit;
    if (!trace(ray, std::numeric_limits<float>::infinity(), query, hit, counters)) return Escaped{};
    if (hit.hit.geomID != object_id) return surface_of_mesh(ray, hit);
    return surface_of_object(ray, query, hit);
}

Visibility TracedGeometry::visibility(const Ray& ray, float far, PathCounters& counters) const {
    if (placed_) {
        const Hit hit = intersect_several(ray, far, counters);
        const Surface* surface = std::get_if<Surface>(&hit);
        if (!surface) return Escaped{};
        if (!surface->is_transparent()) return blocked_by(*surface);
        return *surface;
    }
    embree::Query query;
    RTCRayHit hit;
    if (!trace(ray, far, query, hit, counters)) return Escaped{};
    const bool is_mesh = hit.hit.geomID != object_id;
    const Material& met =
        is_mesh ? scene_.meshes[hit.hit.geomID - first_mesh_id].material : scene_.materials[query.crossing.to.index];
    if (!is_clear(met) && !has_pane(met) && !glows(met)) return Blocked{is_mesh ? hit.ray.tfar : query.crossing.t_from};
    const Surface surface = is_mesh ? surface_of_mesh(ray, hit) : surface_of_object(ray, query, hit);
    if (surface.is_transparent()) return surface;
    return blocked_by(surface);
}

Surface TracedGeometry::surface_of_object(const Ray& ray, const embree::Query& query, const RTCRayHit& hit) const {
    const Crossing& c = query.crossing;
    const CrossingNormal normal = object().normal(hit.hit.primID, c, ray.direction);
    Surface surface{.distance = c.t_from,
                    .normal = -normal.unit,
                    .geometric_normal = -normal.unit,
                    .near_side = {c.p_from, c.from, ray.in, std::nullopt},
                    .far_side = std::nullopt,
                    .optics = interfaces_.between(c.from.index, c.to.index),
                    .hint = {embree::ObjectInstance::of(hit.hit), hit.hit.primID, c.from, normal.gradient},
                    .object = 0,
                    .entered = c.to,
                    .place = {c.p_from, -normal.unit, std::nullopt}};
    if (is_clear(scene_.materials[c.to.index])) surface.far_side = {c.p_to, c.to, ray.in, std::nullopt};
    choose_of_mixture(surface);
    add_bumps_and_grain(surface, ray.direction, AlreadyInScene());
    return surface;
}

Surface TracedGeometry::surface_of_mesh(const Ray& ray, const RTCRayHit& hit) const {
    const std::size_t index = hit.hit.geomID - first_mesh_id;
    const Mesh& mesh = scene_.meshes[index];
    MeshPlace met{mesh, hit.hit.primID, hit.hit.u, hit.hit.v};
    if (moving_meshes_[index]) met.moved = moving_meshes_[index]->at(hit.ray.time);
    const glm::vec3 p = met.point();
    glm::vec3 flat = glm::normalize(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
    bool is_behind = glm::dot(flat, ray.direction) > 0;
    if (is_behind) flat = -flat;
    glm::vec3 shading = flat;
    if (!mesh.normals.empty()) {
        const glm::vec3 mean = met.turned(met.mean(mesh.normals));
        const float length = glm::length(mean);
        // Some triangles of a mesh with normals may lack them.
        if (length > 0) {
            is_behind = glm::dot(mean, flat) < 0;
            const glm::vec3 n = (is_behind ? -mean : mean) / length;
            // At grazing incidence, the shading normal may face away from the ray; the geometric one is kept then.
            if (glm::dot(n, ray.direction) < 0) shading = n;
        }
    }
    const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1.0f});
    const glm::vec3 offset = flat * std::max(surface_epsilon_, relative_surface_epsilon * largest);
    const glm::vec3 origin = p + offset;
    // The origin of rays that leave a smooth mesh. If anything touches the mesh between the triangle and the smooth
    // surface that it approximates, rays leave from the triangle instead.
    glm::vec3 leaves_from = origin;
    if (!mesh.normals.empty() && shading != flat) {
        const glm::vec3 smooth = origin + (met.point_of_smooth_surface(is_behind) - p);
        if (glm::length(smooth - origin) > glm::length(origin - p) && is_free(ray, origin, smooth))
            leaves_from = smooth;
    }
    TexturePoint place(origin, shading, met.coordinates());
    place.is_back = is_behind;
    if (!mesh.tangents.empty() && place.mesh) met.add_tangents(*place.mesh, shading, is_behind);
    const Interface& optics = mesh_interfaces_[index * scene_.materials.size() + ray.phase.index];
    Surface surface{.distance = hit.ray.tfar,
                    .normal = shading,
                    .geometric_normal = flat,
                    .near_side = {leaves_from, ray.phase, ray.in},
                    .far_side = std::nullopt,
                    .optics = optics,
                    .hint = {},
                    .object = first_mesh_ + static_cast<std::uint32_t>(index),
                    .entered = std::nullopt,
                    .place = place};
    if (mesh.opacity) surface.opacity = mesh.opacity->at(TexturePoint(p, flat, place.mesh));
    choose_of_mixture(surface);
    if (surface.optics.get().is_thin()) surface.far_side = {p - offset, ray.phase, ray.in};
    add_bumps_and_grain(surface, ray.direction, AlreadyInScene());
    return surface;
}

bool TracedGeometry::is_free(const Ray& ray, const glm::vec3& from, const glm::vec3& to) const {
    const float distance = glm::length(to - from);
    const Ray between{from, (to - from) / distance, ray.phase, {}, ray.in};
    PathCounters counters;
    if (placed_) return std::holds_alternative<Escaped>(next_of_several(between, distance, counters));
    embree::Query query;
    RTCRayHit hit;
    return !trace(between, distance, query, hit, counters);
}

CellStatistics TracedGeometry::statistics() const {
    CellStatistics all = object().statistics();
    for (std::size_t i = 1; i < cells_.size(); ++i) {
        const CellStatistics one = cells_[i]->statistics();
        all.cells += one.cells;
        all.routines += one.routines;
        all.bytes += one.bytes;
        all.median_instructions = std::max(all.median_instructions, one.median_instructions);
        all.percentile90_instructions = std::max(all.percentile90_instructions, one.percentile90_instructions);
        all.max_instructions = std::max(all.max_instructions, one.max_instructions);
        all.build_seconds += one.build_seconds;
        all.is_coarser |= one.is_coarser;
    }
    return all;
}

TracedGeometry::Inside TracedGeometry::inside(const glm::vec3& p, float time) const {
    if (!placed_) return {object().label(p, Evaluator::thread_workspace()), RayObjects(time)};
    const RayObjects in = placed_->objects_at(embree_.get(), p, time);
    return {in.phase(), in};
}

}  // namespace phasetree::tracer
