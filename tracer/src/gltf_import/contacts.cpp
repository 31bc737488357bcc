#include "gltf_import/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace phasetree::tracer::gltf_import {

namespace {

constexpr std::size_t max_points = 4096;  // of one surface, for one pair
// Limits the number of points over all pairs, unless fewest_points per surface are more. Each point costs an
// evaluation, and about a dozen further ones if it may be at a gap.
constexpr std::size_t max_points_of_all_pairs = 4'000'000;
constexpr float widest_gap = 0.02f;                      // of the smaller solid's diagonal
constexpr float least_depth = 1e-5f, least_gap = 1e-6f;  // of the smaller solid's diagonal; rounding is less
// A solid counts as inside another one if it protrudes by at most this fraction of its own diagonal.
constexpr float max_protrusion = 1e-3f;

struct SurfacePoint {
    glm::vec3 at, normal;
};

// Points distributed uniformly by area over a surface. Point i of n lies where the accumulated area reaches (i + 1/2)/n
// of the whole.
std::vector<SurfacePoint> points_on(const Solid& solid, std::size_t count) {
    std::vector<SurfacePoint> points;
    points.reserve(count);
    double before = 0;
    const double step = solid.area / static_cast<double>(count);
    for (const glm::uvec3& t : solid.mesh.triangles) {
        const glm::dvec3 a(solid.mesh.vertices[t.x]), b(solid.mesh.vertices[t.y]), c(solid.mesh.vertices[t.z]);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n), after = before + 0.5 * length;
        while (length > 0 && points.size() < count && (static_cast<double>(points.size()) + 0.5) * step < after) {
            // The additive recurrence of the plastic number covers a square evenly (Roberts 2018).
            const auto i = static_cast<double>(points.size() + 1);
            const double u = std::fmod(i * 0.7548776662466927, 1.0), v = std::fmod(i * 0.5698402909980532, 1.0);
            const double root = std::sqrt(u);
            points.push_back({glm::vec3((1 - root) * a + root * (1 - v) * b + root * v * c), glm::vec3(n / length)});
        }
        before = after;
    }
    return points;
}

struct Pair {
    std::size_t first, second;
    float widest;
};

bool are_near(const Bounds& a, const Bounds& b, float distance) {
    return !intersect(a.inflated(distance), b).empty();
}

std::vector<Pair> near_pairs(const std::vector<Solid>& solids) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < solids.size(); ++i)
        for (std::size_t k = i + 1; k < solids.size(); ++k) {
            const float widest = widest_gap * std::min(solids[i].bounds.diagonal(), solids[k].bounds.diagonal());
            if (are_near(solids[i].bounds, solids[k].bounds, widest)) pairs.push_back({i, k, widest});
        }
    return pairs;
}

class Finder {
  public:
    Finder(const std::vector<Solid>& solids, std::size_t points) : solids_(solids), points_(points) {}

    Contact find(const Pair& pair) const {
        Contact contact{.first = pair.first, .second = pair.second};
        const Side first = side(pair.first, pair.second, pair.widest),
                   second = side(pair.second, pair.first, pair.widest);
        const float least = least_depth * pair.widest / widest_gap;
        const float depth = std::max(first.depth, second.depth);
        if (depth > least) {
            contact.depth = depth;
            contact.is_first_inside = first.is_inside && !second.is_inside;
            contact.is_second_inside = second.is_inside && !first.is_inside;
        }
        const Side& larger = first.share >= second.share ? first : second;
        if (larger.share > 0)
            contact.gap = Gap{.least = std::min(first.least, second.least),
                              .greatest = std::max(first.greatest, second.greatest),
                              .of = &larger == &first ? pair.first : pair.second,
                              .share = larger.share};
        return contact;
    }

  private:
    // What the points on one solid's surface tell about another solid.
    struct Side {
        float depth = 0;
        bool is_inside = true;
        float least = std::numeric_limits<float>::infinity(), greatest = 0;  // width of the gap
        double share = 0;                                                    // of the points that are at a gap
    };

    Side side(std::size_t of, std::size_t in, float widest) const {
        const Solid &own = solids_[of], &other = solids_[in];
        Side side;
        const float nearest = least_gap * widest / widest_gap, outside = max_protrusion * own.bounds.diagonal();
        std::size_t at_gap = 0, all = 0;
        for (const SurfacePoint& p : points_on(own, points_)) {
            const float d = other.distance(p.at);
            ++all;
            side.depth = std::max(side.depth, -d);
            side.is_inside = side.is_inside && d <= outside;
            if (!(d > nearest && d < widest) || !faces(own, other, p, d) || is_filled(p.at, own, other, d)) continue;
            ++at_gap;
            side.least = std::min(side.least, d);
            side.greatest = std::max(side.greatest, d);
        }
        side.is_inside = side.is_inside && all > 0;
        side.share = all > 0 ? static_cast<double>(at_gap) / static_cast<double>(all) : 0;
        return side;
    }

    // Whether the other surface lies at the distance d along the point's normal (in either sense), on the outer side of
    // this solid.
    static bool faces(const Solid& own, const Solid& other, const SurfacePoint& p, float d) {
        for (const float sign : {1.0f, -1.0f}) {  // triangles may be inside out
            const glm::vec3 n = sign * p.normal;
            if (std::abs(other.distance(p.at + d * n)) < 0.1f * d && is_outside(own, p.at, d * n)) return true;
        }
        return false;
    }

    // Whether a segment that starts on the solid's surface stays outside the solid. Points near its start are tested,
    // too: from the outer face of a thin wall, a segment to the liquid inside passes through the wall first.
    static bool is_outside(const Solid& own, const glm::vec3& at, const glm::vec3& way) {
        return std::ranges::all_of(std::array{0.05f, 0.25f, 0.5f, 0.75f, 0.95f},
                                   [&](float t) { return own.distance(at + t * way) > 0; });
    }

    // Whether a third solid is where the gap would be.
    bool is_filled(const glm::vec3& at, const Solid& own, const Solid& other, float d) const {
        return std::ranges::any_of(solids_, [&](const Solid& solid) {
            return &solid != &own && &solid != &other && solid.bounds.inflated(d).contains(at) &&
                   solid.distance(at) < 0.5f * d;
        });
    }

    const std::vector<Solid>& solids_;
    std::size_t points_;
};

}  // namespace

std::vector<Contact> contacts_of(const std::vector<Solid>& solids) {
    constexpr std::size_t fewest_points = 64;
    const std::vector<Pair> pairs = near_pairs(solids);
    if (pairs.empty()) return {};
    const Finder finder(solids, std::clamp(max_points_of_all_pairs / (2 * pairs.size()), fewest_points, max_points));
    std::vector<Contact> contacts;
    for (const Pair& pair : pairs) {
        const Contact contact = finder.find(pair);
        if (contact.overlap() || contact.gap) contacts.push_back(contact);
    }
    return contacts;
}

}  // namespace phasetree::tracer::gltf_import
