#include "lights/lights.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory_resource>

#include "lights/check.hpp"
#include "lights/luminance.hpp"

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// One number a light, without the heap for the usual handful of them.
class Scratch {
  public:
    explicit Scratch(std::size_t size) : values_(size, 0.0f, &arena_) {}
    operator std::span<float>() { return values_; }
    const std::pmr::vector<float>& values() const { return values_; }

  private:
    std::array<std::byte, 256> buffer_;
    std::pmr::monotonic_buffer_resource arena_{buffer_.data(), buffer_.size()};
    std::pmr::vector<float> values_;
};

}  // namespace

void Lights::set_background(const std::optional<glm::vec3>& radiance) {
    if (radiance) check_colour(*radiance, "the background");
    background_ = radiance;
}

// Fills in the luminance each light sends through p, infinite lights first; returns the sum.
float Lights::fluences(const glm::vec3& p, std::span<float> fluence) const {
    float total = 0.0f;
    std::size_t index = 0;
    for (const InfiniteLight& any : infinite_) {
        fluence[index] = std::visit([](const auto& light) { return light.fluence(); }, any);
        total += fluence[index++];
    }
    for (const AreaLight& any : area_) {
        fluence[index] = std::visit(
            [&](const auto& light) {
                double seen = 0;
                if constexpr (requires { light.rough_solid_angle(p); })
                    seen = light.rough_solid_angle(p);
                else
                    seen = light.solid_angle(p);
                return static_cast<float>(static_cast<double>(luminance(light.radiance())) * seen);
            },
            any);
        total += fluence[index++];
    }
    return total;
}

float Lights::pdf(const glm::vec3& p, const glm::vec3& direction, std::span<const float> fluence, float total) const {
    if (!(total > 0.0f)) return 0.0f;
    float sum = 0.0f;
    std::size_t index = 0;
    for (const InfiniteLight& any : infinite_) {
        const float share = fluence[index++] / total;
        if (share > 0.0f) sum += share * std::visit([&](const auto& light) { return light.pdf(direction); }, any);
    }
    for (const AreaLight& any : area_) {
        const float share = fluence[index++] / total;
        if (share > 0.0f) sum += share * std::visit([&](const auto& light) { return light.pdf(p, direction); }, any);
    }
    return sum;
}

float Lights::pdf(const glm::vec3& p, const glm::vec3& direction) const {
    Scratch fluence(size());
    const float total = fluences(p, fluence);
    return pdf(p, direction, fluence.values(), total);
}

std::optional<LightSample> Lights::sample(const glm::vec3& p, glm::vec2 u) const {
    Scratch scratch(size());
    const float total = fluences(p, scratch);
    const std::span<const float> fluence = scratch.values();
    if (!(total > 0.0f) || total == infinity) return std::nullopt;

    // The last light that shines catches what rounding leaves over at the end.
    std::size_t chosen = 0;
    float below = 0.0f;
    for (std::size_t i = 0; i < fluence.size(); ++i) {
        if (!(fluence[i] > 0.0f)) continue;
        chosen = i;
        below += fluence[i];
        if (u.x * total < below) break;
    }
    u.x = std::clamp((u.x * total - (below - fluence[chosen])) / fluence[chosen], 0.0f, 0x1.fffffep-1f);

    glm::vec3 wi(0.0f);
    if (chosen < infinite_.size()) {
        const auto sampled = std::visit([&](const auto& light) { return light.sample(u); }, infinite_[chosen]);
        if (!sampled) return std::nullopt;
        wi = sampled->direction;
    } else {
        wi = std::visit([&](const auto& light) { return light.sample(p, u); }, area_[chosen - infinite_.size()]);
    }
    const float density = pdf(p, wi, fluence, total);
    // At the very rim of a light rounding can put the direction just outside.
    if (!(density > 0.0f)) return std::nullopt;
    if (const auto hit = nearest(p, wi, infinity, false)) return LightSample{wi, hit->distance, hit->radiance, density};
    return LightSample{wi, infinity, infinite_radiance(wi), density};
}

std::optional<Lights::Hit> Lights::nearest(const glm::vec3& origin, const glm::vec3& direction, float distance_max,
                                           bool camera_ray) const {
    std::optional<Hit> hit;
    for (const AreaLight& any : area_) {
        std::visit(
            [&](const auto& light) {
                if (camera_ray && !light.visible_to_camera()) return;
                const auto distance = light.intersect(origin, direction);
                if (distance && *distance < (hit ? hit->distance : distance_max)) {
                    hit = Hit{*distance, light.radiance()};
                }
            },
            any);
    }
    return hit;
}

std::optional<Lights::Emission> Lights::intersect(const glm::vec3& origin, const glm::vec3& direction,
                                                  float distance_max, bool camera_ray) const {
    const auto hit = nearest(origin, direction, distance_max, camera_ray);
    if (!hit) return std::nullopt;
    return Emission{hit->distance, hit->radiance, pdf(origin, direction)};
}

glm::vec3 Lights::infinite_radiance(const glm::vec3& direction) const {
    glm::vec3 sum(0.0f);
    for (const InfiniteLight& any : infinite_) {
        sum += std::visit([&](const auto& light) { return light.radiance(direction); }, any);
    }
    return sum;
}

Lights::Emission Lights::infinite(const glm::vec3& origin, const glm::vec3& direction, bool camera_ray) const {
    const glm::vec3 radiance = camera_ray && background_ ? *background_ : infinite_radiance(direction);
    return {infinity, radiance, infinite_.empty() ? 0.0f : pdf(origin, direction)};
}

}  // namespace phasetree::tracer
