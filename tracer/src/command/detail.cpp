#include "command/detail.hpp"

#include <glm/geometric.hpp>

#include "command/errors.hpp"
#include "phasetree/tree/levels_of_detail.hpp"

namespace phasetree::tracer {

namespace {

// The smallest angle between the rays of two neighbouring pixels. In a perspective picture it occurs at the corners.
float least_pixel_angle(const Camera& camera, const FilmSettings& film) {
    const auto along = [&](double x, double y) {
        return glm::normalize(glm::dvec3(camera.generate({x, y}, glm::vec2(0.5f)).direction));
    };
    double least = 10;
    for (const double x : {0.5, film.width / 2.0, film.width - 0.5})
        for (const double y : {0.5, film.height / 2.0, film.height - 0.5}) {
            const double inward_x = x > film.width / 2.0 ? -1 : 1, inward_y = y > film.height / 2.0 ? -1 : 1;
            least = std::min({least, glm::distance(along(x, y), along(x + inward_x, y)),
                              glm::distance(along(x, y), along(x, y + inward_y))});
        }
    return static_cast<float>(least);
}

}  // namespace

void choose_levels_of_detail(Scene& scene, float pixels) {
    if (std::holds_alternative<OrthographicParameters>(scene.camera))
        throw UsageError("--detail needs a camera whose rays start at one point, so it cannot be orthographic");
    const Camera camera(scene.camera, {scene.film.width, scene.film.height});
    const float angle = pixels * least_pixel_angle(camera, scene.film);
    scene.object = with_levels_of_detail(scene.object, {.position = position_of(scene.camera), .angle = angle});
}

}  // namespace phasetree::tracer
