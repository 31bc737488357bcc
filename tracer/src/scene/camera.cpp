#include <array>

#include "phasetree/io/read_kind.hpp"
#include "scene/camera_parameters.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

struct NamedFilter {
    std::string_view name;
    PixelFilter filter;
};

const std::array<NamedFilter, 2>& filters() {
    static const std::array<NamedFilter, 2> all{
        {{"blackman_harris", PixelFilter()}, {"box", PixelFilter(PixelFilter::Shape::box, 0.5f)}}};
    return all;
}

}  // namespace

std::vector<std::string_view> names_of_filters() {
    std::vector<std::string_view> names;
    for (const NamedFilter& f : filters()) names.push_back(f.name);
    return names;
}

ThinLensParameters CameraParameters::made() const {
    ThinLensParameters p = *this;
    if (focus_at) {
        if (focus_distance)
            throw ParameterError("focus_at", "\"focus_at\" and \"focus_distance\" say the same; give one of them",
                                 ParameterError::Place::key);
        p.focus_distance = glm::dot(*focus_at - position, glm::normalize(look_at - position));
        if (!(*p.focus_distance > 0)) throw ParameterError("focus_at", "\"focus_at\" is behind the camera");
    }
    for (const NamedFilter& f : filters())
        if (f.name == filter_name) p.filter = f.filter;
    return p;
}

ThinLensParameters read_camera(const Document& document, Value value) {
    const ThinLensParameters p =
        read_kind<CameraParameters>(document, value, "the camera", [](const CameraParameters& c) { return c.made(); });
    try {
        (void)ThinLens(p);
    } catch (const std::invalid_argument& e) {
        throw document.error(value, e.what());
    }
    return p;
}

}  // namespace phasetree::tracer
