#include "phasetree/nodes/copies/scatter.hpp"

#include <cmath>
#include <unordered_map>

namespace phasetree::detail {

namespace {

constexpr double pi = 3.14159265358979323846;

/// The accepted points, so that those near a place are found without asking all.
class Neighbourhood {
  public:
    explicit Neighbourhood(float spacing) : spacing_(spacing) {}

    bool is_free(const glm::vec3& p) const {
        if (spacing_ == 0) return true;
        const glm::ivec3 cell = cell_of(p);
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const auto [from, to] = cells_.equal_range(key(cell + glm::ivec3(i, j, k)));
                    for (auto it = from; it != to; ++it)
                        if (glm::length(it->second - p) < spacing_) return false;
                }
        return true;
    }
    void add(const glm::vec3& p) {
        if (spacing_ > 0) cells_.emplace(key(cell_of(p)), p);
    }

  private:
    glm::ivec3 cell_of(const glm::vec3& p) const { return glm::ivec3(glm::floor(p / spacing_)); }
    static std::uint64_t key(const glm::ivec3& c) {
        const auto part = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) & 0x1fffff; };
        return part(c.x) | part(c.y) << 21 | part(c.z) << 42;
    }

    float spacing_;
    std::unordered_multimap<std::uint64_t, glm::vec3> cells_;
};

glm::dvec3 normal_at(const Field& f, const glm::vec3& p, float h) {
    glm::dvec3 g;
    for (int i = 0; i < 3; ++i) {
        glm::vec3 step(0);
        step[i] = h;
        g[i] = static_cast<double>(distance(f, p + step)) - static_cast<double>(distance(f, p - step));
    }
    const double length = glm::length(g);
    return length > 0 ? g / length : glm::dvec3(0, 0, 1);
}

}  // namespace

std::vector<SurfacePoint> scattered(const Field& surface, int count, float spacing, int seed) {
    const Bounds b = bounds(surface);
    if (b.empty()) throw ModelError("scatter: the surface is empty");
    if (!b.finite()) throw ModelError("scatter: the surface must be bounded");
    const float radius = 0.5f * b.diagonal() * (1 + 1e-4f), smallest = 2e-4f * radius;
    if (!(radius > 1e-9f && radius < 1e9f))
        throw ModelError("scatter: the surface must be between 1e-9 and 1e9 m large");
    // A multiple of the bounds' size, so that no cell's number overflows.
    if (spacing > 0 && spacing < 1e-4f * radius) spacing = 0;
    Neighbourhood taken(spacing);
    std::vector<SurfacePoint> found;
    std::uint64_t state = 0x5851f42d4c957f2du + static_cast<std::uint64_t>(seed);
    const auto most = static_cast<std::size_t>(count);
    const std::size_t lines = 4096 + 16 * most;
    for (std::size_t line = 0; line < lines && found.size() < most; ++line) {
        // A uniform direction, and a uniform point of the disk across it.
        const double z = 2 * next_random(state) - 1, a = 2 * pi * next_random(state), rho = std::sqrt(1 - z * z);
        const glm::dvec3 d(rho * std::cos(a), rho * std::sin(a), z);
        const glm::dvec3 u =
            glm::normalize(glm::cross(d, std::abs(z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 v = glm::cross(d, u);
        const double r = static_cast<double>(radius) * std::sqrt(next_random(state)),
                     angle = 2 * pi * next_random(state);
        const glm::vec3 origin(glm::dvec3(b.centre()) + r * (std::cos(angle) * u + std::sin(angle) * v));
        const glm::vec3 direction(d);
        const auto at = [&](float t) { return origin + t * direction; };
        float before = -radius, value = distance(surface, at(before));
        for (float t = before + std::max(std::abs(value), smallest); t < radius && found.size() < most;) {
            const float next = distance(surface, at(t));
            if ((next < 0) != (value < 0)) {
                float low = before, high = t;
                for (int i = 0; i < 24; ++i) {
                    const float middle = 0.5f * (low + high);
                    ((distance(surface, at(middle)) < 0) == (value < 0) ? low : high) = middle;
                }
                const glm::vec3 p = at(0.5f * (low + high));
                if (taken.is_free(p)) {
                    taken.add(p);
                    found.push_back({p, normal_at(surface, p, smallest)});
                }
            }
            before = t;
            value = next;
            t += std::max(std::abs(value), smallest);
        }
    }
    if (found.empty()) throw ModelError("scatter: no place was found on the surface");
    return found;
}

}  // namespace phasetree::detail
