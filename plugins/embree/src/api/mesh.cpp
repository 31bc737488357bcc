// Meshes the interfaces of a geometry.

#include "phasetree/meshing/phase_mesh.hpp"

#include "api/geometry_data.hpp"
#include "embree_core/line_tracer.hpp"
#include "phasetree/building/options.hpp"

namespace phasetree::embree::api {

namespace {

MeshOptions checked(const PhasetreeMeshOptions* given) {
    PhasetreeMeshOptions o;
    phasetreeInitMeshOptions(&o);
    if (given) o = *given;
    if (!(o.spacing >= 0 && std::isfinite(o.spacing)))
        throw invalid("options->spacing is {}; it must be a length", o.spacing);
    MeshOptions options;
    options.spacing = o.spacing;
    if (o.cancelled) options.cancelled = [o] { return o.cancelled(o.cancelledUserPtr); };
    if (o.progress) options.progress = [o](float done) { o.progress(done, o.progressUserPtr); };
    return options;
}

PhaseMesh made(const Object& object, const MeshOptions& options) {
    try {
        return mesh_of(object.cells().bounds(), line_tracer(object.scene()), options);
    } catch (const MeshingCancelled&) {
        throw BuildCancelled();  // all cancellations raise the same error
    } catch (const ModelError& e) {
        throw invalid("options->spacing: {}", e.what());
    }
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeMakeGeometryMesh(PhasetreeGeometry geometry, const PhasetreeMeshOptions* options,
                                         void (*receive)(const PhasetreeMesh* mesh, void* user_pointer),
                                         void* user_pointer) {
    return guarded_call(__func__, [&] {
        const Object& object = *api::data_of(geometry).object;
        const MeshOptions with = checked(options);
        if (!receive) throw invalid("receive is NULL");
        if (!object.cells().opaque().empty())
            throw not_now("the geometry was built with opaque phases, inside which interfaces are not found");
        const PhaseMesh mesh = made(object, with);
        std::vector<float> vertices;
        std::vector<unsigned> indices;
        std::vector<unsigned char> behind, front;
        vertices.reserve(3 * mesh.vertices.size());
        for (const glm::vec3& v : mesh.vertices) vertices.insert(vertices.end(), {v.x, v.y, v.z});
        indices.reserve(3 * mesh.triangles.size());
        for (const PhaseMesh::Triangle& t : mesh.triangles) {
            indices.insert(indices.end(), t.vertices.begin(), t.vertices.end());
            behind.push_back(t.behind.index);
            front.push_back(t.front.index);
        }
        const PhasetreeMesh handed{vertices.data(), indices.data(),       behind.data(),
                                   front.data(),    mesh.vertices.size(), mesh.triangles.size(),
                                   mesh.spacing,    mesh.crossings,       mesh.skipped};
        receive(&handed, user_pointer);
    });
}
