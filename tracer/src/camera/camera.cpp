#include "camera/camera.hpp"

#include <optional>
#include <utility>

namespace phasetree::tracer {

namespace {

// The parameters and the kinds are in the same order, so their indices agree.
template <std::size_t... I>
Cameras::Any made_of(const AnyCameraParameters& any, const glm::ivec2& resolution, std::index_sequence<I...>) {
    std::optional<Cameras::Any> made;
    const auto make_if_given = [&]<std::size_t i>(std::integral_constant<std::size_t, i>) {
        if (const auto* parameters = std::get_if<i>(&any))
            made.emplace(std::in_place_index<i>, *parameters, resolution);
    };
    (make_if_given(std::integral_constant<std::size_t, I>()), ...);
    return std::move(made).value();
}

}  // namespace

glm::vec3 position_of(const AnyCameraParameters& parameters) {
    return std::visit([](const auto& kind) { return glm::vec3(kind.position); }, parameters);
}

glm::vec3 look_at_of(const AnyCameraParameters& parameters) {
    return std::visit([](const auto& kind) { return glm::vec3(kind.look_at); }, parameters);
}

Camera::Camera(const AnyCameraParameters& parameters, const glm::ivec2& resolution)
    : kind_(made_of(parameters, resolution, std::make_index_sequence<std::variant_size_v<AnyCameraParameters>>())) {}

}  // namespace phasetree::tracer
