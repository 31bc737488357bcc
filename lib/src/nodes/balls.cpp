#include "phasetree/nodes/fields/balls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "phasetree/nodes/phased/particles.hpp"

namespace phasetree {

namespace {

// Coordinates whose squares approach the limits of the range of floats cannot be used in computations.
constexpr float farthest = 1e9f, smallest = 1e-9f;

// "ball 3 of sand.ply", or "ball 3" for a list in the scene.
std::string name_of_ball(std::size_t i, const std::string& path) {
    return fmt::format("ball {}{}{}", i + 1, path.empty() ? "" : " of ", path);
}

// The phase of each ball, as an index into `phases`.
std::vector<std::uint8_t> phases_of_balls(const Particles& n, std::size_t balls) {
    std::vector<std::uint8_t> result(balls, 0);
    const std::size_t listed = n.of_phases.size();
    if (!n.file.content) {
        if (listed != 1 && listed != balls)
            throw ModelError("particles: \"phases\" needs one entry per centre, or one for all");
        for (std::size_t i = 0; i < balls && listed > 1; ++i) result[i] = n.of_phases[i].index;
        if (listed == 1) std::ranges::fill(result, n.of_phases[0].index);
        return result;
    }
    const std::vector<std::uint8_t>& numbers = n.file.content->phases;
    if (numbers.empty()) {
        if (listed != 1)
            throw ModelError(
                fmt::format("particles: {} has no column \"phase\", so \"phases\" must have a single entry",
                            n.file.path.empty() ? "the file" : n.file.path));
        std::ranges::fill(result, n.of_phases[0].index);
        return result;
    }
    for (std::size_t i = 0; i < balls; ++i) {
        if (numbers[i] >= listed)
            throw ModelError(fmt::format("particles: {} has phase {}, counted from 0, but \"phases\" has only {}",
                                         name_of_ball(i, n.file.path), numbers[i], listed));
        result[i] = n.of_phases[numbers[i]].index;
    }
    return result;
}

}  // namespace

std::vector<glm::vec4> detail::given_balls(std::string_view node, const std::vector<glm::vec3>& centres,
                                           const std::vector<float>& radii, const FromFile<BallList>& file) {
    if (centres.empty() == !file.content)
        throw ModelError(fmt::format("{}: either \"centres\" or \"file\" is required", node));
    const std::vector<glm::vec3>& points = file.content ? file.content->centres : centres;
    const bool has_own = file.content && !file.content->radii.empty();
    if (has_own && !radii.empty())
        throw ModelError(fmt::format("{}: remove \"radii\", because the file has its own", node));
    const std::vector<float>& sizes = has_own ? file.content->radii : radii;
    if (points.empty()) throw ModelError(fmt::format("{}: there are no balls", node));
    if (points.size() > BallList::max_balls)
        throw ModelError(fmt::format("{}: there are more than {} balls", node, BallList::max_balls));
    if (sizes.size() != 1 && sizes.size() != points.size())
        throw ModelError(sizes.empty() ? fmt::format("{}: \"radii\" is missing{}", node,
                                                     file.content ? ", and the file has none of its own" : "")
                                       : fmt::format("{}: \"radii\" needs one entry per ball, or one for all", node));
    std::vector<glm::vec4> balls(points.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const float r = sizes[sizes.size() == 1 ? 0 : i];
        balls[i] = glm::vec4(points[i], r);
        if (!(r > 0))
            throw ModelError(fmt::format("{}: the radius of {} is not positive", node, name_of_ball(i, file.path)));
        bool is_usable = r >= smallest && r <= farthest;
        for (int k = 0; k < 3; ++k) is_usable = is_usable && std::abs(balls[i][k]) <= farthest;
        if (!is_usable)
            throw ModelError(fmt::format("{}: {} is smaller than 1e-9 m, or farther or larger than 1e9 m", node,
                                         name_of_ball(i, file.path)));
    }
    return balls;
}

void Balls::prepare() {
    table = balls::make_tree(detail::given_balls(info.name, centres, radii, file));
    box = balls::bounds_of(table.data());
}

const float* Balls::few_balls(const float* data) {
    const std::size_t count = balls::ShortList::count(data);
    if (count > max_in_shader)
        throw ModelError(
            fmt::format("balls: a shader can hold at most {} balls, but there are {}", max_in_shader, count));
    return data;
}

bool Balls::Specialised::is_sound(std::span<const float> data) {
    if (data.empty()) return false;
    const float count = data[0];
    return count >= 1 && count <= static_cast<float>(max_in_box) && count == std::floor(count) &&
           data.size() >= balls::ShortList::floats(data.data());
}

void Particles::prepare() {
    std::vector<glm::vec4> all = detail::given_balls(info.name, centres, radii, file);
    const std::vector<std::uint8_t> phase = phases_of_balls(*this, all.size());
    std::array<std::vector<glm::vec4>, Phase::capacity> of_phase;
    std::array<std::size_t, Phase::capacity> counts{};
    for (const std::uint8_t k : phase) ++counts[k];
    for (std::size_t k = 0; k < counts.size(); ++k) of_phase[k].reserve(counts[k]);
    for (std::size_t i = 0; i < all.size(); ++i) of_phase[phase[i]].push_back(all[i]);
    all = {};
    groups.clear();
    group_of.clear();
    for (std::size_t k = 0; k < of_phase.size(); ++k) {
        if (of_phase[k].empty()) continue;
        Balls& group = groups.emplace_back();
        group.table = balls::make_tree(std::move(of_phase[k]));
        group.box = balls::bounds_of(group.table.data());
        group_of.push_back(Phase{static_cast<std::uint8_t>(k)});
    }
}

Bounds Particles::bounds(BoundsQuery& q, float level) const {
    Bounds box;
    for (const Balls& group : groups) box = unite(box, group.box);
    box = box.inflated(level);
    if (box.empty()) return {};
    return q.placed(box, [&](const glm::dvec3& d) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Balls& group : groups) most = std::max(most, group.support(d, level));
        return most;
    });
}

}  // namespace phasetree
