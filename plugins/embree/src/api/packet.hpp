#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "api/carried_phases.hpp"
#include "embree_core/lanes.hpp"
#include "embree_core/walk.hpp"

namespace phasetree::embree::api {

/// Traces one packet against a geometry with a single primitive, for intersection or occlusion. Each ray steps from
/// crossing to crossing in the object's own scene, until a crossing is shown and no filter function rejects it.
template <class Arguments>
class Packet {
    static constexpr bool occlusion = std::is_same_v<Arguments, RTCOccludedFunctionNArguments>;

  public:
    Packet(const GeometryData& data, const Arguments* arguments)
        : data_(data),
          scene_(data.object->scene()),
          arguments_(arguments),
          n_(arguments->N),
          context_(extended(data, arguments->context)) {
        if constexpr (occlusion) {
            rays_ = arguments->ray;
        } else {
            rays_ = RTCRayHitN_RayN(arguments->rayhit, n_);
            hits_ = RTCRayHitN_HitN(arguments->rayhit, n_);
        }
    }

    /// A ray that runs out of memory hits nothing, because the error cannot be reported, and exceptions cannot pass
    /// through Embree.
    void trace() {
        for (unsigned i = 0; i < n_; ++i) {
            if (arguments_->valid[i] != -1) continue;
            try {
                trace(i);
            } catch (const std::bad_alloc&) {
            }
        }
    }

  private:
    void trace(unsigned i) {
        std::optional<Placement> placement;
        if (!data_.motion.none()) {
            placement = data_.motion.at(RTCRayN_time(rays_, n_, i));
            if (!placement) return;
        }
        const auto ray = ray_within(i, placement);
        if (!ray) return;
        PhasetreeRay* const extended_ray = extended_ray_of(context_, RTCRayN_id(rays_, n_, i));
        const auto phase = carried(extended_ray, arguments_->geomID, *arguments_->context);
        const bool filters = !data_.has(PHASETREE_GEOMETRY_FLAG_NO_FILTERS);
        if (occlusion && !filters && shows_all(data_.shown)) {
            if (scene_.any_crossing(*ray, phase)) write_occlusion(rays_, n_, i);
            return;
        }
        Walk walk(scene_, *ray, phase);
        while (const auto found = walk.next()) {
            if (!data_.shows(found->crossing)) continue;
            if (offer(i, *ray, *found, placement, filters, extended_ray)) return;
        }
    }

    /// A lane's ray in object space.
    std::optional<UnitRay> ray_within(unsigned i, const std::optional<Placement>& placement) const {
        auto ray = unit_ray(rays_, n_, i);
        if (ray && placement)
            ray = UnitRay::of(placement->point_within(ray->origin),
                              placement->direction_within(ray->direction * ray->length), RTCRayN_tnear(rays_, n_, i),
                              RTCRayN_tfar(rays_, n_, i));
        if (ray) ray->near = std::max(ray->near, 0.0f);
        return ray;
    }

    /// Offers a crossing as the lane's hit. If it is accepted, writes the hit and returns true.
    bool offer(unsigned i, const UnitRay& ray, const CellScene::Hit& found, const std::optional<Placement>& placement,
               bool filters, PhasetreeRay* extended_ray) {
        if (occlusion && !filters) {
            write_occlusion(rays_, n_, i);
            return true;
        }
        const Crossing& c = found.crossing;
        float& far = RTCRayN_tfar(rays_, n_, i);
        const float before = far;
        glm::vec3 normal = -scene_.cells().normal(found.cell, c, ray.direction).unit;
        if (placement) normal = placement->normal(normal);
        RTCHitN* const candidate = reinterpret_cast<RTCHitN*>(candidates_.data());
        write_hit(candidate, n_, i, c, normal, found.cell, arguments_->geomID, *arguments_->context);
        // Rounding must not put a hit outside the ray.
        far = std::clamp(c.t_from / ray.length, std::min(RTCRayN_tnear(rays_, n_, i), before), before);
        if (filters && !is_accepted(i, candidate)) {
            far = before;
            return false;
        }
        if constexpr (occlusion) {
            write_occlusion(rays_, n_, i);
        } else {
            RTCHit hit = rtcGetHitFromHitN(candidate, n_, i);
            rtcCopyHitToHitN(hits_, &hit, n_, i);
            if (extended_ray) report(extended_ray->hit, ray, found, placement);
        }
        return true;
    }

    bool is_accepted(unsigned i, RTCHitN* candidate) {
        std::array<int, 16> valid{};
        valid[i] = -1;
        RTCFilterFunctionNArguments call{};
        call.valid = valid.data();
        call.geometryUserPtr = data_.user_pointer;
        call.context = arguments_->context;
        if constexpr (occlusion)
            call.ray = rays_;
        else
            call.ray = reinterpret_cast<RTCRayN*>(arguments_->rayhit);
        call.hit = candidate;
        call.N = n_;
        call_filters(arguments_, &call);
        if (valid[i] == -1 && context_ && context_->filter) context_->filter(&call);
        return valid[i] == -1;
    }

    static void report(PhasetreeHit& hit, const UnitRay& ray, const CellScene::Hit& found,
                       const std::optional<Placement>& placement) {
        Crossing there = found.crossing;
        if (placement) {
            there.p_from = placement->point(there.p_from);
            there.p_to = placement->point(there.p_to);
        }
        write_crossing(hit, there, found.cell, ray.length);
    }

    const GeometryData& data_;
    const CellScene& scene_;
    const Arguments* arguments_;
    unsigned n_;
    const PhasetreeRayContext* context_;
    RTCRayN* rays_ = nullptr;
    RTCHitN* hits_ = nullptr;
    alignas(RTCHit16) std::array<std::byte, sizeof(RTCHit16)> candidates_;
};

}  // namespace phasetree::embree::api
