// Computes the support of a solid along a direction d, the maximum of d·p over it, from empty balls.
//
// Space is divided into beams along d with rectangular cross-sections. Each beam has a *top*, above which it contains
// nothing of the solid. Initially, the top is that of the box. A ball of radius r about a point at height c on the
// beam's axis covers the whole cross-section, whose corners are ρ from the axis, between the
//
//     heights c − √(r² − ρ²) and c + √(r² − ρ²),  if r > ρ.
//
// If that range reaches up to the top, the top falls to its lower end. So a beam is walked downwards like a ray in
// sphere tracing. Near a face perpendicular to d, large balls from far above work best: a ball that touches the face
// stays within ρ²/2r of it all over the cross-section. Once no ball lowers the top further, the beam is divided in two
// along its longer side. The beam with the highest top is always processed next; at any time, its top bounds the solid.
#include "carving/support.hpp"

#include <glm/geometric.hpp>
#include <limits>
#include <queue>

#include "phasetree/math/portable.hpp"

namespace phasetree::carving {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Frame {
    glm::dvec3 u, v, d;

    explicit Frame(const glm::dvec3& along) : d(along) {
        const glm::dvec3 axis = std::abs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        u = glm::normalize(glm::cross(d, axis));
        v = glm::cross(d, u);
    }
    glm::dvec3 local(const glm::dvec3& p) const { return {glm::dot(p, u), glm::dot(p, v), glm::dot(p, d)}; }
    glm::dvec3 world(double a, double b, double height) const { return a * u + b * v + height * d; }
};

struct Beam {
    double u, v, half_u, half_v;
    double top;

    double half_diagonal() const { return portable::hypot(half_u, half_v); }
    bool operator<(const Beam& o) const { return top < o.top; }
};

// The positions of the trial balls above the top, in multiples of the half diagonal.
constexpr std::array<double, batch_size - 1> above{0, 0.5, 1, 2, 6, 20, 60};

// Lowers the beam's top as far as eight balls prove. The last ball is tried just below the top, where it may meet the
// solid; `lower` rises to the height of such a point.
void walk(Beam& beam, const Frame& frame, EmptyBalls& field, double tolerance, double& lower) {
    std::array<glm::dvec3, batch_size> points;
    const double rho = beam.half_diagonal();
    for (std::size_t i = 0; i < above.size(); ++i) points[i] = frame.world(beam.u, beam.v, beam.top + above[i] * rho);
    points[above.size()] = frame.world(beam.u, beam.v, beam.top - 0.5 * tolerance);
    const BallBatch balls = field.at(points);
    for (bool is_lower = true; is_lower;) {
        is_lower = false;
        for (const Ball& ball : balls) {
            // Rounding to floats moves the centre slightly off the axis.
            const glm::dvec3 at = frame.local(ball.centre);
            const double corner =
                portable::hypot(beam.half_u + std::abs(at.x - beam.u), beam.half_v + std::abs(at.y - beam.v));
            if (!(ball.radius > corner)) continue;
            const double half = std::sqrt((ball.radius - corner) * (ball.radius + corner));
            if (at.z + half >= beam.top && at.z - half < beam.top) {
                beam.top = at.z - half;
                is_lower = true;
            }
        }
    }
    for (const Ball& ball : balls)
        if (ball.is_solid) lower = std::max(lower, frame.local(ball.centre).z);
}

}  // namespace

Support support_along(const glm::dvec3& d, EmptyBalls& field, const Bounds& box, double tolerance,
                      std::size_t max_evaluations) {
    const Frame frame(d);
    glm::dvec3 low(infinity), high(-infinity);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = frame.local(glm::dvec3(box.corner(i)));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    std::priority_queue<Beam> beams;
    beams.push(
        {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (high.x - low.x), 0.5 * (high.y - low.y), high.z});
    double lower = -infinity;
    const std::size_t until = field.evaluations() + max_evaluations;
    while (!beams.empty()) {
        Beam beam = beams.top();
        const double rho = beam.half_diagonal();
        if (beam.top - lower <= tolerance || rho <= 0.25 * tolerance) return {beam.top, lower, true};
        if (field.evaluations() >= until) return {beam.top, lower, false};
        beams.pop();
        const double before = beam.top;
        walk(beam, frame, field, tolerance, lower);
        if (beam.top < low.z) continue;  // nothing of the solid is in it
        // Continue with the beam while that pays; otherwise, continue with its halves.
        if (before - beam.top > 0.5 * rho) {
            beams.push(beam);
            continue;
        }
        const bool along_u = beam.half_u > beam.half_v;
        double& half = along_u ? beam.half_u : beam.half_v;
        double& middle = along_u ? beam.u : beam.v;
        half *= 0.5;
        middle -= half;
        beams.push(beam);
        middle += 2 * half;
        beams.push(beam);
    }
    return {-infinity, lower, true};
}

}  // namespace phasetree::carving
