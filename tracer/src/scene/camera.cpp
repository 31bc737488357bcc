#include "scene/parts.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view kinds[] = {"thin_lens", "orthographic"};

// What all kinds have.
template <class Parameters>
void read_view(ObjectReader& reader, Parameters& p) {
    p.position = reader.required<glm::vec3>("position", coordinate);
    p.look_at = reader.required<glm::vec3>("look_at", coordinate);
    p.up = reader.optional("up", p.up);
}

ThinLensParameters read_thin_lens(ObjectReader& reader) {
    const Document& document = reader.document();
    ThinLensParameters p;
    read_view(reader, p);
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
    return p;
}

OrthographicParameters read_orthographic(ObjectReader& reader) {
    OrthographicParameters p;
    read_view(reader, p);
    // The widest picture is 32,768 times as wide as it is high, and rays start no farther away than `farthest`.
    p.height = reader.required<float>(
        "height", Range{.min = 0, .max = 1e10, .min_is_open = true, .description = "positive and at most 1e10"});
    return p;
}

PixelFilter read_filter(ObjectReader& reader) {
    const std::string filter = reader.optional<std::string>("filter", "blackman_harris");
    if (filter == "box") return {PixelFilter::Shape::box, 0.5f};
    if (filter != "blackman_harris")
        throw reader.document().error(*reader.value("filter"), "\"filter\" must be \"blackman_harris\" or \"box\"");
    return {};
}

// A camera of no kind, as most scenes have it, has the thin lens's members and at least two of them.
bool names_its_kind(Value value) {
    return value.is_object() && value.size() == 1 && value[0].is_object();
}

}  // namespace

AnyCameraParameters read_camera(const Document& document, Value value, FilmSettings& film) {
    std::string_view kind = "thin_lens";
    std::string what = "the camera";
    Value members = value;
    if (names_its_kind(value)) {
        members = chosen(document, value, "a camera", kinds);
        kind = members.key();
        what = "the " + std::string(kind) + " camera";
    }
    ObjectReader reader(document, members, what);
    AnyCameraParameters parameters;
    if (kind == "orthographic")
        parameters = read_orthographic(reader);
    else
        parameters = read_thin_lens(reader);
    film.filter = read_filter(reader);
    reader.finish();
    try {
        (void)Camera(parameters, film.resolution());
    } catch (const std::invalid_argument& e) {
        throw document.error(members, e.what());
    }
    return parameters;
}

}  // namespace phasetree::tracer
