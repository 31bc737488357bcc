#include "phasetree/measuring/areas.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree_support/split_mix64.hpp"

namespace phasetree {

namespace {

constexpr std::size_t copies = 32, capacity = Phase::capacity;
constexpr std::size_t first_lines_of_copy = 64;

// The sequence by Roberts (2018) in four dimensions, x ↦ x + α modulo 1, where the components of α are the powers of
// the inverse of the positive root of x⁵ = x + 1. It starts at a random point.
class Sequence {
  public:
    explicit Sequence(std::uint64_t seed) {
        support::SplitMix64 generator(seed);
        for (double& s : shift_) s = static_cast<double>(generator() >> 11) * 0x1p-53;
    }
    std::array<double, 4> at(std::size_t i) const {
        constexpr double root = 1.1673039782614187;
        std::array<double, 4> u{};
        double alpha = 1;
        for (std::size_t k = 0; k < u.size(); ++k) {
            alpha /= root;
            const double x = shift_[k] + static_cast<double>(i) * alpha;
            u[k] = x - std::floor(x);
        }
        return u;
    }

  private:
    std::array<double, 4> shift_{};
};

struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;
};

struct Line {
    glm::vec3 origin, direction;
};

// A line through a ball that starts outside it. Lines are uniformly distributed if u is, in [0, 1)⁴.
Line line_through(const Ball& ball, const std::array<double, 4>& u) {
    const double z = 1 - 2 * u[0], r = std::sqrt(std::max(0.0, 1 - z * z)), a = 2 * std::numbers::pi * u[1];
    const glm::dvec3 d(r * std::cos(a), r * std::sin(a), z);
    const glm::dvec3 helper = std::abs(z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 s = glm::normalize(glm::cross(d, helper)), t = glm::cross(d, s);
    const double offset = ball.radius * std::sqrt(u[2]), b = 2 * std::numbers::pi * u[3];
    const glm::dvec3 origin = ball.centre + offset * (std::cos(b) * s + std::sin(b) * t) - 1.01 * ball.radius * d;
    return {glm::vec3(origin), glm::vec3(d)};
}

// One of several independent copies of the estimate (the replicates of randomised quasi-Monte Carlo): a sequence that
// starts at a random point of its own, and how often its lines have crossed each interface.
struct Copy {
    Sequence sequence;
    std::vector<std::uint64_t> crossings = std::vector<std::uint64_t>(capacity * capacity);

    void count(Phase a, Phase b) {
        const auto [low, high] = std::minmax(a.index, b.index);
        ++crossings[low * capacity + high];
    }
};

class AreaEstimate {
  public:
    AreaEstimate(const Bounds& bounds, const LineTracer& lines, const AreaOptions& options)
        : lines_(lines), options_(options), start_(std::chrono::steady_clock::now()) {
        ball_.centre = glm::dvec3(bounds.centre());
        ball_.radius = 0.5 * static_cast<double>(bounds.diagonal()) * (1 + 1e-5);
        for (std::size_t i = 0; i < copies; ++i) copies_.push_back({Sequence(i)});
    }

    AreaResult run() {
        AreaResult result;
        std::size_t done = 0;
        do {
            const std::size_t next = done == 0 ? first_lines_of_copy : 2 * done;
            if (!trace(done, next)) break;
            done = next;
            result = areas_after(done);
        } while (!result.is_within_tolerance && 2 * done * copies <= options_.max_lines && !is_stopped());
        return result;
    }

  private:
    bool is_stopped() const {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        return elapsed.count() >= options_.seconds || (options_.cancelled && options_.cancelled());
    }
    // Returns false if it was stopped. Some copies then have more lines than others.
    bool trace(std::size_t begin, std::size_t end) {
        std::atomic<bool> is_complete{true};
        tbb::parallel_for(std::size_t{0}, copies, [&](std::size_t k) {
            const FlushSubnormals flush;
            Copy& copy = copies_[k];
            std::vector<CrossingOnLine> found;
            for (std::size_t i = begin; i < end; ++i) {
                constexpr std::size_t lines_between_polls = 64;
                if (i % lines_between_polls == 0 && (!is_complete || (i > 0 && is_stopped()))) {
                    is_complete = false;
                    return;
                }
                const Line line = line_through(ball_, copy.sequence.at(i));
                found.clear();
                lines_(line.origin, line.direction, static_cast<float>(2.02 * ball_.radius), found);
                for (const CrossingOnLine& c : found)
                    if (c.from != c.to) copy.count(c.from, c.to);
            }
        });
        return is_complete;
    }
    // `count(copy)` returns how many crossings of a surface a copy has met.
    template <class Count>
    EstimatedArea estimate(std::size_t lines_of_copy, Count&& count) const {
        const double factor = 2 * std::numbers::pi * ball_.radius * ball_.radius / static_cast<double>(lines_of_copy);
        double sum = 0, squares = 0;
        for (const Copy& copy : copies_) sum += factor * static_cast<double>(count(copy));
        const double mean = sum / copies;
        for (const Copy& copy : copies_) {
            const double off = factor * static_cast<double>(count(copy)) - mean;
            squares += off * off;
        }
        return {mean, std::sqrt(squares / (copies * (copies - 1.0)))};
    }
    AreaResult areas_after(std::size_t lines_of_copy) const {
        AreaResult result;
        result.lines = lines_of_copy * copies;
        result.is_within_tolerance = true;
        for (std::size_t a = 0; a < capacity; ++a)
            for (std::size_t b = a + 1; b < capacity; ++b) {
                const EstimatedArea area =
                    estimate(lines_of_copy, [&](const Copy& c) { return c.crossings[a * capacity + b]; });
                if (area.area > 0)
                    result.contacts.push_back(
                        {area, Phase{static_cast<std::uint8_t>(a)}, Phase{static_cast<std::uint8_t>(b)}});
            }
        for (std::size_t p = 1; p < capacity; ++p) {
            const EstimatedArea area = estimate(lines_of_copy, [&](const Copy& c) {
                std::uint64_t all = 0;
                for (std::size_t o = 0; o < capacity; ++o)
                    if (o != p) all += c.crossings[std::min(p, o) * capacity + std::max(p, o)];
                return all;
            });
            if (!(area.area > 0)) continue;
            result.phases.push_back({area, Phase{static_cast<std::uint8_t>(p)}});
            if (!(area.standard_error <= options_.tolerance * area.area)) result.is_within_tolerance = false;
        }
        if (result.phases.empty()) result.is_within_tolerance = false;
        return result;
    }

    const LineTracer& lines_;
    const AreaOptions& options_;
    std::chrono::steady_clock::time_point start_;
    Ball ball_;
    std::vector<Copy> copies_;
};

}  // namespace

AreaResult estimate_areas(const Bounds& bounds, const LineTracer& lines, const AreaOptions& options) {
    if (bounds.empty()) throw ModelError("the object is empty, so it has no interfaces");
    if (!bounds.finite())
        throw ModelError(
            "the bounds are infinite: the object is unbounded, so its areas are not finite; intersect it with a box");
    if (!(options.tolerance > 0))
        throw ModelError(fmt::format("the tolerance must be a positive number, but is {}", options.tolerance));
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
    return AreaEstimate(bounds, lines, options).run();
}

}  // namespace phasetree
