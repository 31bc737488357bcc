// Triangles in an Embree scene of their own, as a renderer of meshes has them.
#pragma once

#include "mesh/triangles.hpp"
#include "trace/embree_scene.hpp"
#include "trace/many.hpp"

namespace phasetree::bench {

class MeshScene {
  public:
    MeshScene(const Triangles&, RTCBuildQuality);

    struct Hit {
        float distance = 0;
        glm::vec3 normal{0};  // of the triangle, not normalised
    };
    std::optional<Hit> intersect(const Ray& ray) const {
        RTCRayHit hit = rayhit_of(ray);
        embree::Context context;
        embree::initialise(context);
        embree::intersect(scene_.handle(), context, hit);
        if (!embree::is_hit(hit)) return std::nullopt;
        return Hit{hit.ray.tfar, {hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z}};
    }
    Checksum trace(std::span<const Ray> rays, int threads) const {
        return trace_many(rays, threads, [this](const Ray& ray) -> std::optional<float> {
            const auto hit = intersect(ray);
            if (!hit) return std::nullopt;
            return hit->distance;
        });
    }
    RTCDevice device() const { return scene_.device(); }
    RTCScene handle() const { return scene_.handle(); }
    // Vertices, indices and Embree's hierarchy.
    std::size_t bytes() const { return scene_.bytes(); }

  private:
    EmbreeScene scene_;
};

}  // namespace phasetree::bench
