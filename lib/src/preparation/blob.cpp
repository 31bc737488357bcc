#include "phasetree/nodes/fields/blob.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>

#include "preparation/prepared_field.hpp"
#include "tree/node.hpp"

namespace phasetree {

using model::Preparation;
using preparation::BatchOfPoints, preparation::PreparedField;

namespace {

// The supremum over a ball of Σ wᵢ |gᵢ′(dᵢ)|, from the distances at its centre. |gᵢ′| = 6x(1 − x²)²/Rᵢ with x = d/R
// increases up to x² = 1/5 and decreases from there.
double steepness(const Blob& blob, const std::vector<double>& distances, double radius) {
    double sum = 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double falloff_radius = static_cast<double>(blob.radius(i)), top = std::sqrt(0.2);
        const double low = std::max(distances[i] - radius, 0.0) / falloff_radius,
                     high = (distances[i] + radius) / falloff_radius;
        if (low >= 1) continue;
        const double x = std::clamp(top, low, std::min(high, 1.0));
        sum += static_cast<double>(blob.weight(i)) / falloff_radius * 6 * x * (1 - x * x) * (1 - x * x);
    }
    return sum;
}

// Computes the distances to a blob's skeletons.
class Skeletons {
  public:
    Skeletons(const Blob& blob, Preparation& preparation) : blob_(blob), preparation_(preparation) {
        own_steps_ = blob.points.size() + 3 * blob.segments.size();
        for (const Field& f : blob.of) fields_.emplace_back(Blob::info.name, f, preparation);
    }

    // Computes the distances at the first `count` points of a batch.
    void find(const BatchOfPoints& p, std::size_t count) {
        preparation_.pay(count * own_steps_);
        values_.clear();
        for (PreparedField& f : fields_) values_.push_back(f(p));
        for (std::size_t lane = 0; lane < count; ++lane) {
            std::vector<double>& all = at_[lane];
            all.clear();
            const Vec3<float> q{p.x[lane], p.y[lane], p.z[lane]};
            for (const glm::vec3& v : blob_.points)
                all.push_back(static_cast<double>(glm::length(glm::vec3(q.x, q.y, q.z) - v)));
            if (!blob_.segments.empty()) {
                float nearest = Bounds::infinity;
                for (const Blob::Segment& s : blob_.segments) nearest = std::min(nearest, s.distance(q));
                all.push_back(static_cast<double>(nearest));
            }
            for (const BatchOfFloats& v : values_) all.push_back(static_cast<double>(v[lane]));
        }
    }
    // The distances at one point to all skeletons, in order.
    const std::vector<double>& at(std::size_t lane) const { return at_[lane]; }
    // The cost of one call of find().
    std::uint64_t steps() const {
        std::uint64_t steps = batch_size * (1 + own_steps_);
        for (const PreparedField& f : fields_) steps += f.steps();
        return steps;
    }

  private:
    const Blob& blob_;
    Preparation& preparation_;
    std::vector<PreparedField> fields_;
    std::uint64_t own_steps_ = 0;
    std::vector<BatchOfFloats> values_;
    std::array<std::vector<double>, batch_size> at_;
};

// An upper bound on sup ‖∇b‖ over all space, close to the maximum of Σ wᵢ |gᵢ′|. The supports are covered by cubes, and
// the cube with the largest bound is divided until that no longer helps (branch and bound).
double blob_slope(const Blob& blob) {
    double everywhere = 0;
    for (std::size_t i = 0; i < blob.count(); ++i)
        everywhere += static_cast<double>(blob.weight(i)) * static_cast<double>(steepest_falloff / blob.radius(i));
    BoundsQuery query;
    Bounds support;
    std::size_t i = 0;
    const auto grown = [&](const std::vector<glm::vec3>& some) {
        Bounds b;
        for (const glm::vec3& v : some) b = unite(b, Bounds{v, v});
        support = unite(support, b.inflated(blob.radius(i++)));
    };
    for (const glm::vec3& v : blob.points) grown({v});
    if (!blob.polyline.empty()) grown(blob.polyline);
    for (const Field& f : blob.of) support = unite(support, query(f, blob.radius(i++)));
    if (!support.finite() || support.empty()) return everywhere;

    struct Cube {
        double bound;
        glm::vec3 centre;
        float half;  // of the edge
        bool operator<(const Cube& o) const { return bound < o.bound; }
    };
    std::priority_queue<Cube> cubes;
    double largest = 0;  // the largest sum found at a cube's centre
    Preparation preparation(Blob::info.name);
    Skeletons skeletons(blob, preparation);
    const auto add = [&](std::span<const glm::vec3> centres, float half) {
        skeletons.find(BatchOfPoints::of(centres), centres.size());
        for (std::size_t lane = 0; lane < centres.size(); ++lane) {
            const std::vector<double>& d = skeletons.at(lane);
            largest = std::max(largest, steepness(blob, d, 0));
            cubes.push(
                {steepness(blob, d, static_cast<double>(half) * std::sqrt(3.0) * (1 + 1e-6)), centres[lane], half});
        }
    };
    const glm::vec3 extent = support.extent(), middle = support.centre();
    add({&middle, 1}, 0.5f * std::max({extent.x, extent.y, extent.z}) * (1 + 1e-6f));
    // Skeletons with many instructions are evaluated less often. The result is still an upper bound.
    const std::uint64_t affordable = batch_size * (preparation.left() / 8 / skeletons.steps());
    const std::size_t most =
        std::min<std::uint64_t>(std::clamp<std::size_t>(2'000'000 / blob.count(), 2'000, 50'000), affordable);
    for (std::size_t n = 0; n < most && cubes.top().bound > 1.02 * largest; n += 8) {
        const Cube cube = cubes.top();
        cubes.pop();
        const float half = 0.5f * cube.half;
        std::array<glm::vec3, 8> centres;
        for (int corner = 0; corner < 8; ++corner)
            centres[static_cast<std::size_t>(corner)] =
                cube.centre + half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        add(centres, half);
    }
    return std::min(everywhere, cubes.top().bound);
}

}  // namespace

void Blob::prepare() {
    if (count() == 0) throw ModelError("blob: skeletons are required: \"points\", a \"polyline\" or fields in \"of\"");
    if (polyline.size() == 1) throw ModelError("blob: a polyline needs at least two points");
    const auto fits = [&](const std::vector<float>& list) { return list.size() <= 1 || list.size() == count(); };
    if (!fits(radii) || !fits(weights))
        throw ModelError("blob: \"radii\" and \"weights\" need one entry per skeleton, or one for all");
    for (const float r : radii) detail::require_usable(info.name, {r});
    for (const float w : weights) detail::require_usable(info.name, {w});
    for (const auto* list : {&points, &polyline})
        for (const glm::vec3& v : *list)
            if (!(glm::length(v) < 1e9f)) throw ModelError("blob: its points must be within 1e9 m of the origin");
    double sum = 0;
    for (std::size_t i = 0; i < count(); ++i) sum += static_cast<double>(weight(i));
    level = static_cast<float>(static_cast<double>(threshold) / sum);
    if (!(level < 1)) throw ModelError("blob: the threshold exceeds the sum of all skeletons, so the solid is empty");
    if (!(level > 1e-12f)) throw ModelError("blob: the threshold is too small");
    segments.clear();
    for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
        const glm::vec3 along = polyline[i + 1] - polyline[i];
        const float squared = glm::dot(along, along);
        segments.push_back({polyline[i], along, squared > 1e-18f ? 1 / squared : 0.f});
    }
    slope = static_cast<float>(blob_slope(*this) * (1 + 1e-5));
}

}  // namespace phasetree
