#include "phasetree/trace/tracer.hpp"

#include <cmath>

#include "trace/march.hpp"

namespace phasetree {

InterfaceTracer::InterfaceTracer(const Phased& object, float resolution) {
    const Bounds b = phasetree::bounds(object);
    if (b.empty()) throw ModelError("the object is empty: nothing of it is left");
    if (!b.finite())
        throw ModelError(
            "the object is unbounded: intersect it with a shape, as in {\"intersect_shape\": {\"of\": …, \"shape\": "
            "…}}");
    // Coordinates are known to half an ulp; a field's value to a few ulps of the coordinates it is made of.
    const float farthest = std::max({std::abs(b.low.x), std::abs(b.low.y), std::abs(b.low.z), std::abs(b.high.x),
                                     std::abs(b.high.y), std::abs(b.high.z)});
    resolution_ = resolution > 0 ? resolution : std::max(2e-6f * b.diagonal(), 1e-6f * farthest);
    bounds_ = b.inflated(8 * resolution_);
    evaluator_ = std::make_shared<const Evaluator>(record(object));
}

namespace {

struct Interval {
    double low, high;
};

/// Where a ray is within a box, clipped to [t_min, t_max]; empty if low > high. In double, so that an origin far from
/// the object costs no accuracy.
Interval clip(const Bounds& box, const glm::dvec3& origin, const glm::dvec3& direction, double t_min, double t_max) {
    Interval r{t_min, t_max};
    for (int i = 0; i < 3; ++i) {
        const double low = static_cast<double>(box.low[i]) - origin[i],
                     high = static_cast<double>(box.high[i]) - origin[i];
        if (direction[i] == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        const double a = low / direction[i], b = high / direction[i];
        r.low = std::max(r.low, std::min(a, b));
        r.high = std::min(r.high, std::max(a, b));
    }
    return r;
}

}  // namespace

std::optional<Crossing> InterfaceTracer::first_crossing(const glm::vec3& origin, const glm::vec3& direction,
                                                        float t_min, float t_max, std::optional<Phase> carried,
                                                        Evaluator::Workspace& w, TraceCounters* counters) const {
    TraceCounters unused;
    TraceCounters& c = counters ? *counters : unused;
    const glm::dvec3 o(origin), d(direction);
    const Interval span = clip(bounds_, o, d, static_cast<double>(t_min), static_cast<double>(t_max));
    if (!(span.low <= span.high) || !std::isfinite(span.high)) return std::nullopt;
    ++c.rays;
    // March from the entry, so that t is small and exact there. A ray that starts inside keeps its very origin.
    const glm::vec3 start = span.low > 0 ? glm::vec3(o + span.low * d) : origin;
    auto hit =
        march(*evaluator_, start, direction, static_cast<float>(span.high - span.low), resolution_, carried, w, c);
    if (hit) {
        hit->t_in = static_cast<float>(span.low + static_cast<double>(hit->t_in));
        hit->t_out = static_cast<float>(span.low + static_cast<double>(hit->t_out));
    }
    return hit;
}

glm::vec3 InterfaceTracer::normal(const Crossing& c, const glm::vec3& direction) const {
    // Both gradients are normals of the same interface. Beside an edge one of them may belong to a neighbouring face
    // that the ray does not cross: then the other is right.
    const auto unit = [](const glm::vec3& g) {
        const float l = glm::length(g);
        return l > 0 ? g / l : glm::vec3(0);
    };
    const glm::vec3 leaving = unit(evaluator_->gradient(c.p_in, c.from));
    if (glm::dot(leaving, direction) > 0) return leaving;
    const glm::vec3 entering = -unit(evaluator_->gradient(c.p_out, c.to));
    if (glm::dot(entering, direction) > 0) return entering;
    return direction;
}

Phase InterfaceTracer::label(const glm::vec3& p, Evaluator::Workspace& w) const {
    return bounds_.contains(p) ? evaluator_->label(p, w) : vacuum;
}

}  // namespace phasetree
