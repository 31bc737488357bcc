#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "lights/daylight.hpp"
#include "lights/load_environment.hpp"
#include "scene/parts.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view kinds[] = {"constant", "gradient", "image", "sky", "sun", "rectangle", "sphere"};

// "radiance", a colour of any magnitude, times "intensity".
glm::vec3 radiance(ObjectReader& reader) {
    return reader.optional_colour("radiance", glm::vec3(1.0f)) *
           reader.optional("intensity", 1.0f, Range::not_negative());
}

// By their paths: a file is read once, however many lights it makes.
using Images = std::map<std::filesystem::path, std::shared_ptr<const EnvironmentImage>>;

void read_image(ObjectReader& reader, Lights& lights, Images& images) {
    const Value file = reader.required_value("file");
    (void)as<std::string>(reader.document(), file, "\"file\"");
    const std::filesystem::path path = reader.document().file(file);
    const float rotation = reader.optional("rotation", 0.0f);
    const float intensity = reader.optional("intensity", 1.0f, Range::not_negative());
    try {
        std::error_code problem;
        const std::filesystem::path real = std::filesystem::weakly_canonical(path, problem);
        auto& image = images[problem ? path : real];
        if (!image) image = load_environment_image(path.string());
        lights.add(ImageEnvironment(image, rotation, intensity));
    } catch (const std::runtime_error& e) {
        throw reader.document().error(file, e.what());
    }
}

void read_sky(ObjectReader& reader, Lights& lights) {
    DaylightParameters p;
    p.sun_elevation_degrees = reader.optional("sun_elevation", p.sun_elevation_degrees, Range::between(-90, 90));
    p.sun_azimuth_degrees = reader.optional("sun_azimuth", p.sun_azimuth_degrees);
    p.sun_angular_diameter_degrees = reader.optional("sun_diameter", p.sun_angular_diameter_degrees,
                                                     Range{.min = 0, .max = 90, .min_is_open = true});
    p.turbidity = reader.optional("turbidity", p.turbidity, Range::between(1, 10));
    p.ground_albedo = reader.optional_colour("ground", p.ground_albedo, Range::between(0, 1));
    p.intensity = reader.optional("intensity", p.intensity, Range::not_negative());
    const bool with_sun = reader.optional("sun", true);
    Daylight daylight = make_daylight(p);
    lights.add(std::move(daylight.sky));
    if (with_sun && p.sun_elevation_degrees > -p.sun_angular_diameter_degrees) lights.add(daylight.sun);
}

void read_gradient(ObjectReader& reader, Lights& lights) {
    const float intensity = reader.optional("intensity", 1.0f, Range::not_negative());
    const glm::vec3 zenith = reader.required_colour("zenith") * intensity;
    const glm::vec3 horizon = reader.required_colour("horizon") * intensity;
    const glm::vec3 ground = reader.required_colour("ground") * intensity;
    lights.add(GradientEnvironment(zenith, horizon, ground,
                                   reader.optional("softness", 1.0f, Range{.min = 0, .max = 1, .min_is_open = true})));
}

void read_sun(ObjectReader& reader, Lights& lights) {
    const glm::vec3 direction = reader.required<glm::vec3>("direction");
    if (!(glm::length(direction) > 0))
        throw reader.document().error(*reader.value("direction"), "\"direction\" has no direction");
    const glm::vec3 irradiance = reader.optional_colour("irradiance", glm::vec3(1.0f));
    lights.add(Sun(direction, irradiance,
                   reader.optional("diameter", Sun::real_angular_diameter_degrees,
                                   Range{.min = 0, .max = 90, .min_is_open = true})));
}

void read_rectangle(ObjectReader& reader, Lights& lights) {
    const glm::vec3 centre = reader.required<glm::vec3>("centre", coordinate);
    const glm::vec3 target = reader.required<glm::vec3>("target", coordinate);
    const float width = reader.required<float>("width", size_of_thing);
    const float height = reader.required<float>("height", size_of_thing);
    if (!(glm::length(target - centre) > 0))
        throw reader.document().error(*reader.value("target"), "\"target\" is where the light itself is");
    lights.add(AreaLight(RectangleLight::facing(centre, target, width, height, radiance(reader),
                                                reader.optional("visible_to_camera", true))));
}

void read_sphere(ObjectReader& reader, Lights& lights) {
    const glm::vec3 centre = reader.required<glm::vec3>("centre", coordinate);
    const float radius = reader.required<float>("radius", size_of_thing);
    lights.add(AreaLight(SphereLight(centre, radius, radiance(reader), reader.optional("visible_to_camera", true))));
}

void read_light(const Document& document, Value value, Lights& lights, Images& images) {
    const Value member = chosen(document, value, "a light", kinds);
    const std::string_view kind = member.key();
    ObjectReader reader(document, member, fmt::format("the {} light", kind));
    try {
        if (kind == "constant") lights.add(ConstantEnvironment(radiance(reader)));
        if (kind == "gradient") read_gradient(reader, lights);
        if (kind == "image") read_image(reader, lights, images);
        if (kind == "sky") read_sky(reader, lights);
        if (kind == "sun") read_sun(reader, lights);
        if (kind == "rectangle") read_rectangle(reader, lights);
        if (kind == "sphere") read_sphere(reader, lights);
    } catch (const std::invalid_argument& e) {
        throw document.error(member, e.what());
    }
    reader.finish();
}

}  // namespace

Lights read_lights(const Document& document, Value root) {
    Lights lights;
    if (const std::optional<Value> list = root.find("lights")) {
        if (!list->is_array())
            throw document.error(*list, fmt::format("\"lights\" must be a list, but is {}", name_of(list->kind())));
        Images images;
        for (const Value light : *list) read_light(document, light, lights, images);
    }
    if (const std::optional<Value> background = root.find("background"))
        lights.set_background(as_colour(document, *background, "\"background\""));
    return lights;
}

}  // namespace phasetree::tracer
