// From whole numbers at voxels to a smooth field for each phase (phased/labels.hpp).
#include "phasetree/nodes/phased/labels.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "model/preparation.hpp"

namespace phasetree {

namespace {

// In voxels: by how much a voxel's own phase is deeper there than all others, at least. Where blurring has made another
// phase deeper by some amount, the own one leads by that amount afterwards, but by most_margin at most; else thin walls
// and threads would vanish.
constexpr float least_margin = 0.02f, most_margin = 0.3f;
// Depths nearer than this to the greatest or least depth are set to it, so that most blocks hold one value and take no
// room.
constexpr float all_the_same = 1e-4f;
constexpr int no_phase = -1;

using Size = std::array<int, 3>;

std::size_t count_of(const Size& n) {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

// Φ⁻¹, by Newton's method on the complementary error function; u from 0.001 to 0.999.
double inverse_normal(double u) {
    double x = 0;
    for (int i = 0; i < 20; ++i) {
        const double value = 0.5 * std::erfc(-x / std::numbers::sqrt2);
        const double slope = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
        // A step of more than 1 could leave the range in which the slope is not almost 0.
        x -= std::clamp((value - u) / slope, -1.0, 1.0);
    }
    return x;
}

// How deep in a phase a point is, in voxels, by what blurring has left there of the phase's indicator, its share: the
// distance to a flat interface with that share, σ Φ⁻¹(share). It is asked for at each voxel and phase, hence tabulated.
class DepthOfShare {
  public:
    explicit DepthOfShare(float sigma) : most_(sigma > 0 ? 2.5f * sigma : 0.5f) {
        for (std::size_t i = 0; i < table_.size(); ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
            const double inner = std::clamp(share, 0.001, 0.999);
            // Without a blur a share is 0 or 1.
            const double depth = sigma > 0 ? static_cast<double>(sigma) * inverse_normal(inner) : share - 0.5;
            table_[i] = std::clamp(static_cast<float>(depth), -most_, most_);
        }
    }
    float most() const { return most_; }
    float operator()(float share) const {
        const float at = std::clamp(share, 0.f, 1.f) * static_cast<float>(table_.size() - 1);
        const auto i = std::min(static_cast<std::size_t>(at), table_.size() - 2);
        const float t = at - static_cast<float>(i);
        return table_[i] + t * (table_[i + 1] - table_[i]);
    }

  private:
    float most_;
    std::array<float, 4097> table_;
};

// Calls work(line) for all lines of voxels along an axis, which are copied to it and back; layers of them in parallel.
template <class Work>
void for_each_line(std::vector<float>& values, const Size& n, std::size_t axis, const Work& work) {
    constexpr std::array<std::array<std::size_t, 2>, 3> others{{{1, 2}, {0, 2}, {0, 1}}};
    const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(n[0]),
                                            static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1])};
    const std::size_t u = others[axis][0], v = others[axis][1];
    tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(n[v]), [&](std::size_t j) {
        std::vector<float> line(static_cast<std::size_t>(n[axis]));
        for (std::size_t i = 0; i < static_cast<std::size_t>(n[u]); ++i) {
            float* first = values.data() + i * stride[u] + j * stride[v];
            for (std::size_t k = 0; k < line.size(); ++k) line[k] = first[k * stride[axis]];
            work(line);
            for (std::size_t k = 0; k < line.size(); ++k) first[k * stride[axis]] = line[k];
        }
    });
}

// Convolution with a Gaussian. Beyond its ends a line goes on as it ends.
class Blur {
  public:
    explicit Blur(float sigma) {
        const int reach = static_cast<int>(std::ceil(3.5f * sigma));
        double sum = 0;
        for (int i = -reach; i <= reach; ++i) {
            const double x = sigma > 0 ? i / static_cast<double>(sigma) : 0;
            weights_.push_back(static_cast<float>(std::exp(-0.5 * x * x)));
            sum += static_cast<double>(weights_.back());
        }
        for (float& w : weights_) w = static_cast<float>(static_cast<double>(w) / sum);
    }
    void operator()(std::vector<float>& line) const {
        // Lines of one phase, or of none of it, are most of all.
        if (std::ranges::all_of(line, [&](float x) { return x == line[0]; })) return;
        const std::size_t reach = weights_.size() / 2;
        std::vector<float> longer(line.size() + 2 * reach);
        std::fill_n(longer.begin(), reach, line.front());
        std::ranges::copy(line, longer.begin() + static_cast<std::ptrdiff_t>(reach));
        std::fill_n(longer.end() - static_cast<std::ptrdiff_t>(reach), reach, line.back());
        for (std::size_t i = 0; i < line.size(); ++i) {
            float sum = 0;
            for (std::size_t k = 0; k < weights_.size(); ++k) sum += weights_[k] * longer[i + k];
            line[i] = sum;
        }
    }

  private:
    std::vector<float> weights_;
};

// Replaces values by the coefficients of the quadratic B-spline through them, along a line: cₖ with
// cₖ₋₁/8 + 6cₖ/8 + cₖ₊₁/8 = vₖ, where c goes on beyond the ends as it ends. Elimination without pivots is stable, for
// the diagonal dominates.
void to_spline(std::vector<float>& line) {
    if (std::ranges::all_of(line, [&](float x) { return x == line[0]; })) return;
    const std::size_t n = line.size();
    std::vector<double> above(n), right(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double diagonal = i == 0 || i + 1 == n ? 7. / 8 : 6. / 8;
        const double pivot = diagonal - (i > 0 ? above[i - 1] / 8 : 0);
        above[i] = 1. / 8 / pivot;
        right[i] = (static_cast<double>(line[i]) - (i > 0 ? right[i - 1] / 8 : 0)) / pivot;
    }
    double c = 0;
    for (std::size_t i = n; i-- > 0;) {
        c = right[i] - (i + 1 < n ? above[i] * c : 0);
        line[i] = static_cast<float>(c);
    }
}

// What a voxel's own phase has as its depth, and by how much it is above that of any other.
struct Own {
    float depth = 0, margin = 0;
};

class LabelDepths {
  public:
    LabelDepths(const LabelGrid& grid, const VoxelLattice& lattice, std::vector<int> phases, float sigma)
        : grid_(grid), lattice_(lattice), phases_(std::move(phases)), blur_(sigma), depth_of_(sigma) {}

    std::vector<Labels::Part> of(const std::vector<int>& present) {
        own_.assign(count_of(lattice_.size), {-depth_of_.most(), -depth_of_.most()});
        for (const int phase : present) {
            const std::vector<float> depths = blurred(phase);
            for (std::size_t i = 0; i < depths.size(); ++i) {
                if (phase_at(i) == phase)
                    own_[i].depth = depths[i];
                else
                    own_[i].margin = std::max(own_[i].margin, depths[i]);  // so far the greatest of the others
            }
        }
        for (Own& own : own_) {
            // The own depth takes half of what is lacking; depth_in() lowers the others by the rest.
            const float ahead = own.depth - own.margin;
            own.margin = std::max(least_margin, std::min(-ahead, most_margin));
            own.depth += 0.5f * std::max(own.margin - ahead, 0.f);
        }
        std::vector<VoxelGrid> grids;
        double steepest = 0;
        for (const int phase : present) {
            grids.push_back(depth_in(phase));
            steepest = std::max(steepest, grids.back().steepest_spline());
        }
        std::vector<Labels::Part> parts;
        for (std::size_t i = 0; i < present.size(); ++i) {
            // One divisor for all, so that each is 1-Lipschitz and their differences keep their signs.
            if (steepest > 0) grids[i].divide_by(steepest * (1 + 1e-6));
            parts.push_back({present[i], std::make_shared<const VoxelGrid>(std::move(grids[i]))});
        }
        return parts;
    }

  private:
    int phase_at(std::size_t voxel) const { return phases_[grid_.voxels[voxel]]; }

    // The depth in a phase, from its share after blurring.
    std::vector<float> blurred(int phase) const {
        std::vector<float> share(grid_.voxels.size());
        for (std::size_t i = 0; i < share.size(); ++i) share[i] = phase_at(i) == phase ? 1.f : 0.f;
        for (std::size_t axis = 0; axis < 3; ++axis) for_each_line(share, lattice_.size, axis, blur_);
        for (float& s : share) s = depth_of_(s);
        return share;
    }

    VoxelGrid depth_in(int phase) const {
        std::vector<float> depths = blurred(phase);
        for (std::size_t i = 0; i < depths.size(); ++i)
            depths[i] = phase_at(i) == phase ? own_[i].depth : std::min(depths[i], own_[i].depth - own_[i].margin);
        for (std::size_t axis = 0; axis < 3; ++axis) for_each_line(depths, lattice_.size, axis, to_spline);
        const double h = std::min({lattice_.spacing.x, lattice_.spacing.y, lattice_.spacing.z});
        const auto scale = static_cast<float>(-h);
        const Size& n = lattice_.size;
        // Blocks that are deep in the phase, or far from it, hold one value.
        const float most = depth_of_.most();
        for (float& d : depths)
            for (const float limit : {-most, most})
                if (std::abs(d - limit) < all_the_same) d = limit;
        return VoxelGrid::of_voxels("labels", lattice_, [&](int x, int y, int z) {
            return scale * depths[static_cast<std::size_t>(x) +
                                  static_cast<std::size_t>(n[0]) *
                                      (static_cast<std::size_t>(y) +
                                       static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(z))];
        });
    }

    const LabelGrid& grid_;
    VoxelLattice lattice_;
    std::vector<int> phases_;  // of each of the grid's numbers
    Blur blur_;
    DepthOfShare depth_of_;
    std::vector<Own> own_;
};

bool is_whole(float x) {
    return x == std::floor(x) && std::abs(x) <= 16777216.f;
}

// The phases of the numbers that occur in the grid.
std::vector<int> phases_of_numbers(const Labels& n) {
    const LabelGrid& grid = *n.file.content;
    std::vector<int> phases;
    for (const std::int32_t number : grid.numbers) {
        const auto is_number = [&](float v) { return static_cast<double>(v) == static_cast<double>(number); };
        int phase = no_phase;
        for (std::size_t i = 0; i < n.of_phases.size(); ++i) {
            const float value = n.values.empty() ? static_cast<float>(i + 1) : n.values[i];
            if (is_number(value)) phase = n.of_phases[i].index;
        }
        const bool is_empty = n.empty.empty() ? number == 0 : std::ranges::any_of(n.empty, is_number);
        if (phase == no_phase && is_empty) phase = vacuum.index;
        phases.push_back(phase);
    }
    return phases;
}

void refuse_unknown_number(const LabelGrid& grid, const std::vector<int>& phases) {
    const auto unknown = std::ranges::find_if(grid.voxels, [&](std::uint8_t v) { return phases[v] == no_phase; });
    if (unknown == grid.voxels.end()) return;
    const auto at = static_cast<std::size_t>(unknown - grid.voxels.begin());
    const auto [nx, ny, nz] = grid.lattice.size;
    const auto x = at % static_cast<std::size_t>(nx),
               y = at / static_cast<std::size_t>(nx) % static_cast<std::size_t>(ny),
               z = at / static_cast<std::size_t>(nx) / static_cast<std::size_t>(ny);
    throw ModelError(
        fmt::format("labels: the voxel ({}, {}, {}), counted from 0, has the number {}, which is that of no phase; "
                    "\"values\" gives numbers to phases, \"empty\" to the vacuum",
                    x, y, z, grid.numbers[*unknown]));
}

// Where the voxels are: a grid's own place, or about the origin.
VoxelLattice placed(const LabelGrid& grid, const glm::vec3& spacing) {
    VoxelLattice lattice = grid.lattice;
    const bool is_given = spacing.x > 0 && spacing.y > 0 && spacing.z > 0;
    if (grid.has_spacing) {
        if (spacing != glm::vec3(0))
            throw ModelError("labels: the grid has a spacing of its own; leave out \"spacing\"");
        return lattice;
    }
    if (!is_given)
        throw ModelError(
            "labels: images do not say how large their voxels are: \"spacing\" must be [x, y, z], each "
            "positive");
    lattice.spacing = glm::dvec3(spacing);
    for (glm::length_t i = 0; i < 3; ++i)
        lattice.first[i] = -0.5 * (lattice.size[static_cast<std::size_t>(i)] - 1) * lattice.spacing[i];
    return lattice;
}

}  // namespace

void Labels::prepare() {
    const LabelGrid& content = *file.content;
    if (!values.empty() && values.size() != of_phases.size())
        throw ModelError(fmt::format("labels: {} phases need as many \"values\", but there are {}", of_phases.size(),
                                     values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!is_whole(values[i]) ||
            std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]))
            throw ModelError("labels: \"values\" must be whole numbers, each of one phase");
    if (!std::ranges::all_of(empty, is_whole)) throw ModelError("labels: \"empty\" must be whole numbers");
    if (count_of(content.lattice.size) > LabelGrid::most_voxels)
        throw ModelError(fmt::format("labels: the grid has more than {} voxels", LabelGrid::most_voxels));
    if (content.voxels.empty() || content.voxels.size() != count_of(content.lattice.size))
        throw ModelError("labels: the grid has not all its voxels");
    const std::vector<int> phase_of = phases_of_numbers(*this);
    refuse_unknown_number(content, phase_of);

    const VoxelLattice lattice = placed(content, spacing);
    std::array<bool, Phase::capacity> is_present{};
    for (const std::uint8_t v : content.voxels) is_present[static_cast<std::size_t>(phase_of[v])] = true;
    std::vector<int> present;
    for (int i = 0; i < Phase::capacity; ++i)
        if (is_present[static_cast<std::size_t>(i)]) present.push_back(i);
    model::PreparationTogether::pay(info.name, content.voxels.size() * present.size());
    parts = LabelDepths(content, lattice, phase_of, smoothing).of(present);

    const Bounds extent = parts.front().depth->extent();
    box = {extent.centre(), extent.extent() * 0.5f};
    solid = extent;
    // Where the vacuum's blocks and all around them hold its greatest depth, no other phase is.
    if (parts.size() > 1 && parts.front().phase == vacuum.index) {
        solid = {};
        for (std::size_t i = 1; i < parts.size(); ++i) {
            const VoxelGrid& depth = *parts[i].depth;
            const double most =
                DepthOfShare(smoothing).most() * std::min({lattice.spacing.x, lattice.spacing.y, lattice.spacing.z});
            const auto lowest = static_cast<float>(most / depth.divided_by * (1 - 1e-5));
            const Bounds part = depth.blocks_below(lowest);
            if (!part.empty()) solid = unite(solid, part);
        }
    }
}

}  // namespace phasetree
