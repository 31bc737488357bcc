#include "scene/parts.hpp"

namespace phasetree::tracer {

ThinLensParameters read_camera(const Document& document, Value value) {
    ObjectReader reader(document, value, "the camera");
    ThinLensParameters p;
    p.position = reader.required<glm::vec3>("position", coordinate);
    p.look_at = reader.required<glm::vec3>("look_at", coordinate);
    p.up = reader.optional("up", p.up);
    p.vertical_fov_degrees = reader.optional("fov", p.vertical_fov_degrees,
                                             Range{.min = 0, .max = 180, .min_is_open = true, .max_is_open = true});
    p.lens_radius = reader.optional("lens_radius", p.lens_radius,
                                    Range{.min = 0, .max = farthest, .description = "from 0 to 1e15"});
    p.focus_distance = reader.maybe<float>("focus_distance", Range::positive());
    if (const auto focus = reader.maybe<glm::vec3>("focus_at", coordinate)) {
        if (p.focus_distance)
            throw document.error(reader.value("focus_at")->key_offset(),
                                 "\"focus_at\" and \"focus_distance\" say the same; give one of them");
        p.focus_distance = glm::dot(*focus - p.position, glm::normalize(p.look_at - p.position));
        if (!(*p.focus_distance > 0))
            throw document.error(*reader.value("focus_at"), "\"focus_at\" is behind the camera");
    }
    const std::string filter = reader.optional<std::string>("filter", "blackman_harris");
    if (filter == "box")
        p.filter = PixelFilter(PixelFilter::Shape::box, 0.5f);
    else if (filter != "blackman_harris")
        throw document.error(*reader.value("filter"), "\"filter\" must be \"blackman_harris\" or \"box\"");
    reader.finish();
    try {
        (void)ThinLens(p);
    } catch (const std::invalid_argument& e) {
        throw document.error(value, e.what());
    }
    return p;
}

}  // namespace phasetree::tracer
