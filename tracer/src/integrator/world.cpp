#include "integrator/world.hpp"

#include <cmath>
#include <cstring>
#include <new>

#include "integrator/kept_cells.hpp"

namespace phasetree::tracer {

namespace {

constexpr unsigned tree_id = 0;

}  // namespace

World::World(const Scene& scene, const WorldOptions& wanted) : scene_(scene), interfaces_(scene.materials) {
    CellOptions options;
    options.quality = wanted.quality;
    options.cancelled = wanted.cancelled;
    options.progress = wanted.progress;
    options.most_bytes = wanted.most_bytes;
    options.opaque = opaque_phases(scene.materials);
    object_ = wanted.kept_cells ? kept_cells(*wanted.kept_cells, scene.object, options)
                                : std::make_shared<const InterfaceCells>(scene.object, options);
    device_ = rtcNewDevice(nullptr);
    if (!device_) throw std::runtime_error("Embree cannot be started");
    embree_ = rtcNewScene(device_);
    // The nearest hit of everything, whatever the order of a million small triangles: exactness before speed.
    rtcSetSceneFlags(embree_, RTC_SCENE_FLAG_ROBUST);
    tree_.emplace(device_, object_, embree::CellGeometry::Options{.rays_carry_phases = true});
    rtcCommitGeometry(tree_->handle());
    rtcAttachGeometryByID(embree_, tree_->handle(), tree_id);
    hair_ = 1e-5f * object_->bounds().diagonal();
    for (const Mesh& mesh : scene.meshes) add_mesh(mesh);
    rtcCommitScene(embree_);
    flat_boundaries_ = tracer::flat_boundaries(*this, scene);
}

World::~World() {
    if (embree_) rtcReleaseScene(embree_);
    tree_.reset();
    if (device_) rtcReleaseDevice(device_);
}

void World::add_mesh(const Mesh& mesh) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             mesh.vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                              mesh.triangles.size());
    std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(glm::vec3));
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    rtcCommitGeometry(geometry);
    const auto id = static_cast<unsigned>(mesh_interfaces_.size() / scene_.materials.size()) + tree_id + 1;
    rtcAttachGeometryByID(embree_, geometry, id);
    rtcReleaseGeometry(geometry);
    for (const Material& from : scene_.materials) mesh_interfaces_.push_back(Interface::between(from, mesh.material));
}

std::optional<Surface> World::intersect(const glm::vec3& origin, const glm::vec3& direction, float far, Phase carried,
                                        const Start& start, Purpose purpose, PathCounters& counters) const {
    embree::Query query;
    query.phases.set(embree::ObjectInstance{tree_id}, carried);
    query.start = start;
    RTCRayHit ray = embree::rayhit_of(origin, direction, 0, far);
    embree::intersect(embree_, query.context, ray);
    if (query.is_out_of_memory) throw std::bad_alloc();
    ++counters.rays;
    counters.trace.visits += query.counters.visits;
    counters.trace.batches += query.counters.batches;
    counters.trace.phantoms += query.counters.phantoms;
    if (!embree::is_hit(ray)) return std::nullopt;
    const bool is_on_tree = ray.hit.geomID == tree_id;
    const Crossing& c = query.crossing;
    Surface s;
    s.distance = is_on_tree ? c.t_in : ray.ray.tfar;
    const bool ends_here = !is_on_tree || !is_clear(scene_.materials[c.to.index]);
    if (purpose == Purpose::light && ends_here) return s;
    if (!is_on_tree) return on_mesh(ray, direction, carried);

    const CrossingNormal normal = object_->normal(ray.hit.primID, c, direction);
    s.normal = -normal.unit;
    s.near_origin = c.p_in;
    s.far_origin = c.p_out;
    s.near_phase = c.from;
    s.far_phase = c.to;
    s.optics = &interfaces_.between(c.from.index, c.to.index);
    s.start = {embree::ObjectInstance::of(ray.hit), ray.hit.primID, c.from, normal.gradient};
    return s;
}

Surface World::on_mesh(const RTCRayHit& ray, const glm::vec3& direction, Phase carried) const {
    const std::size_t index = ray.hit.geomID - tree_id - 1;
    const Mesh& mesh = scene_.meshes[index];
    const glm::uvec3& t = mesh.triangles[ray.hit.primID];
    const float u = ray.hit.u, v = ray.hit.v;
    // The point by the triangle's own coordinates: exact to an ulp of those, however far the ray has come.
    const glm::vec3 p = (1 - u - v) * mesh.vertices[t.x] + u * mesh.vertices[t.y] + v * mesh.vertices[t.z];
    glm::vec3 flat = glm::normalize(glm::vec3(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z));
    if (glm::dot(flat, direction) > 0) flat = -flat;
    Surface s;
    s.distance = ray.ray.tfar;
    s.normal = flat;
    if (!mesh.normals.empty()) {
        glm::vec3 n = glm::normalize((1 - u - v) * mesh.normals[t.x] + u * mesh.normals[t.y] + v * mesh.normals[t.z]);
        if (glm::dot(n, flat) < 0) n = -n;
        if (glm::dot(n, direction) < 0) s.normal = n;  // else the ray grazes, and the shading normal faces away
    }
    const float size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1.0f});
    s.near_origin = p + flat * std::max(hair_, 1e-5f * size);
    s.far_origin = s.near_origin;
    s.near_phase = s.far_phase = carried;
    s.optics = &mesh_interfaces_[index * scene_.materials.size() + carried.index];
    return s;
}

Phase World::label(const glm::vec3& p) const {
    return object_->label(p, Evaluator::thread_workspace());
}

}  // namespace phasetree::tracer
