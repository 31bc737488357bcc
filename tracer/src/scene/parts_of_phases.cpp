#include <algorithm>
#include <array>

#include "image/luminance.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/shining_parts.hpp"

namespace phasetree::tracer {

namespace {

// More balls aim better, and choosing among them takes longer. Halving the boxes doubles their number along a rod that
// is thinner than they are, and quadruples it on a surface. A growth below 3 counts as a rod, which its balls fill the
// better the smaller they are.
constexpr std::size_t most_boxes = 64, most_boxes_of_rod = 512;
constexpr std::size_t growth_of_rod = 3;
constexpr float finest = 1e-4f;  // of the object's diagonal

constexpr float least_share = 1.0f / 32;

std::array<Bounds, 8> eighths(const Bounds& box) {
    std::array<Bounds, 8> parts;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner = box.corner(i), centre = box.centre();
        parts[static_cast<std::size_t>(i)] = {glm::min(corner, centre), glm::max(corner, centre)};
    }
    return parts;
}

enum class Counts { surface_alone, inside_too };

// Finds those boxes that may have some of a phase.
class PhaseFinder {
  public:
    explicit PhaseFinder(const Phased& tree)
        : bounds_(prepare_to_trace(tree).bounds),
          evaluator_(record(tree)),
          values_(evaluator_.program().outputs.size()) {}

    // Within a box; none if nothing is there that counts.
    std::vector<Bounds> boxes_of(Phase phase, const Bounds& within, Counts counts) {
        std::vector<Bounds> boxes{intersect(bounds_, within)};
        if (boxes.front().empty()) return {};
        for (;;) {
            std::vector<Bounds> finer;
            for (const Bounds& box : boxes) {
                add_eighths(box, phase, counts, finer);
                if (finer.size() > most_boxes_of_rod) break;
            }
            if (finer.empty()) return {};
            const bool is_rod = finer.size() < growth_of_rod * boxes.size();
            if (finer.size() > (is_rod ? most_boxes_of_rod : most_boxes)) return boxes;
            boxes = std::move(finer);
            if (boxes.front().diagonal() < finest * bounds_.diagonal()) return boxes;
        }
    }

  private:
    void add_eighths(const Bounds& box, Phase phase, Counts counts, std::vector<Bounds>& kept) {
        const auto& outputs = evaluator_.program().outputs;
        const auto output = std::ranges::find(outputs, phase, &Output::phase);
        if (output == outputs.end()) return;
        const std::array<Bounds, 8> parts = eighths(box);
        static_assert(batch_size == parts.size());
        BatchOfFloats x, y, z;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const glm::vec3 centre = parts[i].centre();
            x[i] = centre.x;
            y[i] = centre.y;
            z[i] = centre.z;
        }
        evaluator_.evaluate(x, y, z, values_, Evaluator::thread_workspace());
        const BatchOfFloats& distance = values_[static_cast<std::size_t>(output - outputs.begin())];
        // Rounding must not lose a surface that passes through a corner.
        const float radius = 1.001f * 0.5f * parts.front().diagonal();
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (distance[i] <= radius && (counts == Counts::inside_too || distance[i] >= -radius))
                kept.push_back(parts[i]);
    }

    Bounds bounds_;
    Evaluator evaluator_;
    std::vector<BatchOfFloats> values_;
};

// A medium as dense as it gets, along the mean way through the box's ball, which is 4/3 of the radius, or as far as one
// can see in it.
float luminance_in(const Bounds& box, const Medium& medium) {
    const float through = 4.0f / 3 * 0.5f * box.diagonal();
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (ScatteringMediumKind<Kind>) {
                const ScatteringCoefficients& c = kind.coefficients();
                return luminance(c.emission / glm::max(c.extinction(), 1.0f / through));
            } else {
                return 0.0f;
            }
        },
        medium);
}

// Where it shines: outside of this box there is nothing of it.
Bounds bounds_of_light(const Material& material) {
    const Clear* clear = std::get_if<Clear>(&material);
    const VaryingMedium* varying = clear ? std::get_if<VaryingMedium>(&clear->interior) : nullptr;
    return varying ? varying->bounds() : Bounds::everything();
}

// The surface in a box is looked at in its centre and halfway to its corners.
float luminance_in(const Bounds& box, const Material& of_phase) {
    if (const Clear* clear = std::get_if<Clear>(&of_phase)) return luminance_in(box, clear->interior);
    const auto& material = std::get<Glowing>(of_phase);
    const auto place_at = [](const glm::vec3& p) { return TexturePoint{p, {0, 0, 1}, std::nullopt}; };
    std::vector<TexturePoint> places{place_at(box.centre())};
    for (int i = 0; i < 8; ++i) places.push_back(place_at(0.5f * (box.centre() + box.corner(i))));
    return luminance_at(places, material);
}

}  // namespace

float luminance_at(std::span<const TexturePoint> places, const Glowing& material) {
    float sum = 0;
    for (const TexturePoint& place : places) sum += luminance(color_at(material.light, place));
    return material.radiance * std::max(sum / static_cast<float>(places.size()), least_share);
}

std::vector<ShiningPart> parts_of_phases(const Phased& tree, std::span<const Material> materials) {
    const PhaseSet present = phases(tree);
    std::vector<ShiningPart> parts;
    std::optional<PhaseFinder> finder;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Phase phase{static_cast<std::uint8_t>(i)};
        if (!shines(materials[i]) || !present.contains(phase)) continue;
        if (!finder) finder.emplace(tree);
        const Counts counts = glows(materials[i]) ? Counts::surface_alone : Counts::inside_too;
        for (const Bounds& box : finder->boxes_of(phase, bounds_of_light(materials[i]), counts))
            parts.push_back(part_in(box, luminance_in(box, materials[i])));
    }
    return parts;
}

}  // namespace phasetree::tracer
