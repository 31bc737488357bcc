#include "phasetree/nodes/copies/scatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>

#include "phasetree_support/split_mix64.hpp"
#include "preparation/prepared_field.hpp"

namespace phasetree::detail {

using model::Preparation;
using preparation::BatchOfPoints, preparation::PreparedField;
using support::SplitMix64;

namespace {

constexpr double pi = 3.14159265358979323846;

// The next number in [0, 1).
double next_fraction(SplitMix64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// The accepted points, in a hashed grid, so that points near a given point are found without visiting all of them.
class Neighbourhood {
  public:
    explicit Neighbourhood(float spacing) : spacing_(spacing) {}

    // Whether no point is closer than the spacing.
    bool is_free(const glm::vec3& p) const {
        if (spacing_ == 0) return true;
        const glm::ivec3 cell = cell_of(p);
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const auto [begin, end] = cells_.equal_range(key(cell + glm::ivec3(i, j, k)));
                    for (auto it = begin; it != end; ++it)
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
        const auto low_bits = [](int v) {
            return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) & 0x1fffff;
        };
        return low_bits(c.x) | low_bits(c.y) << 21 | low_bits(c.z) << 42;
    }

    float spacing_;
    std::unordered_multimap<std::uint64_t, glm::vec3> cells_;
};

// A straight line through the ball around the surface, and the state of the search along it for changes of the field's
// sign.
struct Line {
    glm::vec3 origin{}, direction{};
    float before = 0;  // the line has been searched up to here
    float value = 0;   // the field's value there
    float t = 0;       // where to evaluate the field next

    glm::vec3 at(float along) const { return origin + along * direction; }
};
// A change of the field's sign between two points of a line.
struct Change {
    std::size_t line = 0;
    float low = 0, high = 0;
    bool is_negative = false;  // whether the field is negative at `low`
};

// Finds points of a surface along random lines, eight lines at a time.
class Search {
  public:
    Search(const Field& surface, const glm::vec3& centre, float radius, int seed)
        : preparation_("scatter"),
          surface_("scatter", surface, preparation_),
          centre_(centre),
          radius_(radius),
          smallest_(2e-4f * radius),
          random_(0x5851f42d4c957f2du + static_cast<std::uint64_t>(seed)) {}

    // The points where the next eight lines cross the surface, line by line.
    std::vector<glm::vec3> crossings() {
        for (Line& line : lines_) line = random_line();
        std::vector<Change> changes = march();
        std::ranges::stable_sort(changes, {}, &Change::line);
        std::vector<glm::vec3> found;
        for (std::size_t first = 0; first < changes.size(); first += batch_size)
            bisect(std::span(changes).subspan(first, std::min(batch_size, changes.size() - first)));
        for (const Change& c : changes) found.push_back(lines_[c.line].at(0.5f * (c.low + c.high)));
        return found;
    }
    // The unit normal of the surface near a point, by central differences.
    glm::dvec3 normal_at(const glm::vec3& p) {
        BatchOfPoints around;
        for (std::size_t lane = 0; lane < batch_size; ++lane) {
            glm::vec3 step(0);
            step[static_cast<int>(lane % 3)] = smallest_;
            around.set(lane, lane < 3 ? p + step : p - step);
        }
        const BatchOfFloats f = surface_(around);
        glm::dvec3 g;
        for (int i = 0; i < 3; ++i)
            g[i] = static_cast<double>(f[static_cast<std::size_t>(i)]) -
                   static_cast<double>(f[static_cast<std::size_t>(i) + 3]);
        const double length = glm::length(g);
        return length > 0 ? g / length : glm::dvec3(0, 0, 1);
    }

  private:
    // A line with a uniformly random direction through a uniformly random point of the disk perpendicular to it.
    Line random_line() {
        const double z = 2 * next_fraction(random_) - 1, a = 2 * pi * next_fraction(random_),
                     rho = std::sqrt(1 - z * z);
        const glm::dvec3 d(rho * std::cos(a), rho * std::sin(a), z);
        const glm::dvec3 u =
            glm::normalize(glm::cross(d, std::abs(z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 v = glm::cross(d, u);
        const double r = static_cast<double>(radius_) * std::sqrt(next_fraction(random_)),
                     angle = 2 * pi * next_fraction(random_);
        return {glm::vec3(glm::dvec3(centre_) + r * (std::cos(angle) * u + std::sin(angle) * v)), glm::vec3(d)};
    }
    // The field at one point of each line.
    BatchOfFloats along_lines(float Line::*t) {
        BatchOfPoints points;
        for (std::size_t i = 0; i < lines_.size(); ++i) points.set(i, lines_[i].at(lines_[i].*t));
        return surface_(points);
    }
    float step(float value) const { return std::max(std::abs(value), smallest_); }
    // Finds the changes of sign along all lines. They are sphere-traced together, each with its own step lengths.
    std::vector<Change> march() {
        std::vector<Change> changes;
        for (Line& line : lines_) line.before = -radius_;
        const BatchOfFloats first = along_lines(&Line::before);
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            lines_[i].value = first[i];
            lines_[i].t = lines_[i].before + step(first[i]);
        }
        while (std::ranges::any_of(lines_, [&](const Line& l) { return l.t < radius_; })) {
            const BatchOfFloats next = along_lines(&Line::t);
            for (std::size_t i = 0; i < lines_.size(); ++i) {
                Line& line = lines_[i];
                if (!(line.t < radius_)) continue;
                if ((next[i] < 0) != (line.value < 0)) changes.push_back({i, line.before, line.t, line.value < 0});
                line.before = line.t;
                line.value = next[i];
                line.t += step(next[i]);
            }
        }
        return changes;
    }
    // Narrows up to eight changes of sign by bisection.
    void bisect(std::span<Change> changes) {
        for (int n = 0; n < 24; ++n) {
            BatchOfPoints points;
            const auto middle = [](const Change& c) { return 0.5f * (c.low + c.high); };
            for (std::size_t i = 0; i < changes.size(); ++i)
                points.set(i, lines_[changes[i].line].at(middle(changes[i])));
            const BatchOfFloats f = surface_(points);
            for (std::size_t i = 0; i < changes.size(); ++i) {
                Change& c = changes[i];
                const float m = middle(c);
                ((f[i] < 0) == c.is_negative ? c.low : c.high) = m;
            }
        }
    }

    Preparation preparation_;
    PreparedField surface_;
    glm::vec3 centre_;
    float radius_, smallest_;
    SplitMix64 random_;
    std::array<Line, batch_size> lines_;
};

}  // namespace

std::vector<SurfacePoint> scattered(const Field& surface, int count, float spacing, int seed) {
    const Bounds b = bounds(surface);
    if (b.empty()) throw ModelError("scatter: the surface is empty");
    if (!b.finite()) throw_unbounded("scatter: the surface", surface);
    const float radius = 0.5f * b.diagonal() * (1 + 1e-4f);
    if (!(radius > 1e-9f && radius < 1e9f))
        throw ModelError("scatter: the surface must be between 1e-9 and 1e9 m large");
    // A smaller spacing would overflow the cell numbers of the grid; at this size it excludes nothing.
    if (spacing > 0 && spacing < 1e-4f * radius) spacing = 0;
    Neighbourhood taken(spacing);
    std::vector<SurfacePoint> found;
    Search search(surface, b.centre(), radius, seed);
    const auto most = static_cast<std::size_t>(count);
    const std::size_t lines = 4096 + 16 * most;
    static_assert(16 % batch_size == 0, "all lines of a batch count");
    for (std::size_t line = 0; line < lines && found.size() < most; line += batch_size)
        for (const glm::vec3& p : search.crossings()) {
            if (found.size() == most) break;
            if (!taken.is_free(p)) continue;
            taken.add(p);
            found.push_back({p, search.normal_at(p)});
        }
    if (found.empty()) throw ModelError("scatter: no position was found on the surface");
    return found;
}

std::vector<Placement> scattered_placements(const Field& surface, int count, float spacing, float smallest, int seed) {
    std::vector<Placement> placements;
    SplitMix64 random(static_cast<std::uint64_t>(seed));
    for (const SurfacePoint& at : scattered(surface, count, spacing, seed)) {
        const double turn = 360 * next_fraction(random);
        const double size = static_cast<double>(smallest) + (1 - static_cast<double>(smallest)) * next_fraction(random);
        placements.push_back(Placement::standing(at.position, at.normal, turn, static_cast<float>(size)));
    }
    return placements;
}

}  // namespace phasetree::detail
