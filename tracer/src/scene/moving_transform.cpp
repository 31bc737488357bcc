#include "scene/moving_transform.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

// The eigenvalues and eigenvectors of a symmetric matrix, computed by Jacobi rotations (Golub and Van Loan: Matrix
// Computations, section 8.5).
struct Axes {
    glm::dmat3 directions{1};  // columns
    glm::dvec3 values{0};
};

Axes axes_of(glm::dmat3 m) {
    Axes axes;
    for (int sweep = 0; sweep < 32; ++sweep) {
        double off = 0, on = 0;
        for (int i = 0; i < 3; ++i) {
            on += m[i][i] * m[i][i];
            for (int k = 0; k < i; ++k) off += m[i][k] * m[i][k];
        }
        if (off <= 1e-34 * on) break;
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (m[p][q] == 0) continue;
            const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
            const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            glm::dmat3 rotation(1);
            rotation[p][p] = rotation[q][q] = c;
            rotation[q][p] = s;
            rotation[p][q] = -s;
            m = glm::transpose(rotation) * m * rotation;
            axes.directions = axes.directions * rotation;
        }
    }
    axes.values = {m[0][0], m[1][1], m[2][2]};
    return axes;
}

// An upper bound on the absolute eigenvalues of a symmetric matrix.
double greatest(const glm::dmat3& symmetric) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, std::abs(symmetric[i].x) + std::abs(symmetric[i].y) + std::abs(symmetric[i].z));
    return most;
}

// The angle of the shorter rotation from one to the other.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const double cosine = std::min(std::abs(glm::dot(a, b)), 1.0);
    // The cosine of a small angle is imprecise; the distance between the quaternions is not.
    const double distance = std::min(glm::length(a - b), glm::length(a + b));
    return cosine > 0.9 ? 4 * portable::asin(std::min(distance / 2, 1.0)) : 2 * portable::acos(cosine);
}

}  // namespace

// S = √(Mᵀ M), and R = M S⁻¹. If the transform mirrors, both change sign, so that R is a rotation.
Pose Pose::of(const Transform& transform) {
    const Axes axes = axes_of(glm::transpose(transform.matrix) * transform.matrix);
    const double sign = glm::determinant(transform.matrix) < 0 ? -1 : 1;
    glm::dmat3 lengths(0), inverse(0);
    for (int i = 0; i < 3; ++i) {
        lengths[i][i] = sign * std::sqrt(std::max(axes.values[i], 0.0));
        inverse[i][i] = 1 / lengths[i][i];
    }
    const glm::dmat3 back = glm::transpose(axes.directions);
    const glm::dmat3 turn = transform.matrix * (axes.directions * inverse * back);
    return {glm::normalize(glm::quat_cast(turn)), axes.directions * lengths * back, transform.by};
}

Pose between(const Pose& from, const Pose& to, double share) {
    return {glm::slerp(from.turn, to.turn, share), from.stretch * (1 - share) + to.stretch * share,
            glm::mix(from.by, to.by, share)};
}

Transform MovingTransform::at(double time) const {
    const auto after = std::ranges::upper_bound(moments_, time, {}, &Moment::time);
    if (after == moments_.begin()) return moments_.front().pose.transform();
    if (after == moments_.end()) return moments_.back().pose.transform();
    const Moment& before = *(after - 1);
    return between(before.pose, after->pose, (time - before.time) / (after->time - before.time)).transform();
}

// Between two moments a point moves along x(s) = R(s) S(s) p + v(s), with s from 0 to 1. R rotates at the constant
// speed θ, and S and v change linearly, so |x''| ≤ θ² |S| |p| + 2 θ |S'| |p|. The distance of a curve from the chord
// between two of its points, h apart in s, is at most max |x''| h²/8. So the union of the boxes at both ends, enlarged
// by that, contains the path.
Bounds MovingTransform::swept(const Bounds& box) const {
    if (box.empty()) return {};
    double farthest_point = 0;
    for (int corner = 0; corner < 8; ++corner)
        farthest_point = std::max(farthest_point, glm::length(glm::dvec3(box.corner(corner))));
    Bounds all = moments_.front().pose.transform().image(box);
    for (std::size_t i = 0; i + 1 < moments_.size(); ++i) {
        const Pose &from = moments_[i].pose, &to = moments_[i + 1].pose;
        const double angle = angle_between(from.turn, to.turn);
        const double longest = std::max(greatest(from.stretch), greatest(to.stretch));
        const double second = (angle * longest + 2 * greatest(to.stretch - from.stretch)) * angle * farthest_point;
        const int steps = std::clamp(static_cast<int>(std::ceil(angle * 12)), 1, 64);
        const double off = 1.001 * second / (8.0 * steps * steps);
        for (int step = 0; step <= steps; ++step) {
            const double share = static_cast<double>(step) / steps;
            all = unite(all, between(from, to, share).transform().image(box).inflated(static_cast<float>(off)));
        }
    }
    return all;
}

double MovingTransform::stretch() const {
    double most = 0;
    for (const Moment& moment : moments_) most = std::max(most, greatest(moment.pose.stretch));
    return most;
}

}  // namespace phasetree::tracer
