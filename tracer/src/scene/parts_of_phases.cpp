#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "image/luminance.hpp"
#include "phasetree/model/poll_preparation.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/emissive_parts.hpp"

namespace phasetree::tracer {

namespace {

// More balls allow better aiming, but choosing among them takes longer. Halving the boxes doubles their number if the
// part is a rod thinner than a box, and quadruples it if it is a surface. So a growth factor below 3 indicates a rod.
// Rods may have more balls, because they fill small balls better.
constexpr std::size_t max_boxes = 16, most_boxes_of_rod = 128;
constexpr std::size_t growth_of_rod = 3;
constexpr float finest = 1e-4f;  // as a fraction of the object's diagonal

std::array<Bounds, 8> eighths(const Bounds& box) {
    std::array<Bounds, 8> parts;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner = box.corner(i), centre = box.centre();
        parts[static_cast<std::size_t>(i)] = {glm::min(corner, centre), glm::max(corner, centre)};
    }
    return parts;
}

// The centres of a box's octants.
PointBatch centres_of_eighths(const Bounds& box) {
    const std::array<Bounds, 8> parts = eighths(box);
    static_assert(batch_size == parts.size());
    PointBatch points;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const glm::vec3 centre = parts[i].centre();
        points.x[i] = centre.x;
        points.y[i] = centre.y;
        points.z[i] = centre.z;
    }
    return points;
}

// An upper bound on the distance of the box's points from its centre. The margin prevents rounding from losing a
// surface that passes through a corner.
float circumradius(const Bounds& box) {
    return 1.001f * 0.5f * box.diagonal();
}

enum class Counts { surface_alone, inside_too };

// Finds boxes that may contain a part of a phase.
class PhaseFinder {
  public:
    explicit PhaseFinder(const Phased& tree)
        : bounds_(prepare_to_trace(tree).bounds),
          evaluator_(record(tree)),
          values_(evaluator_.program().outputs.size()) {}

    // Boxes that cover the relevant part of the phase in `within`; empty if there is none.
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
            if (finer.size() > (is_rod ? most_boxes_of_rod : max_boxes)) return boxes;
            boxes = std::move(finer);
            if (boxes.front().diagonal() < finest * bounds_.diagonal()) return boxes;
        }
    }

    // φ at the centres of a box's octants.
    BatchOfFloats distances(const PointBatch& at, Phase phase) {
        poll_preparation();  // if the object has many copies, each evaluation takes milliseconds
        const auto& outputs = evaluator_.program().outputs;
        const auto output = std::ranges::find(outputs, phase, &Output::phase);
        evaluator_.evaluate(at.x, at.y, at.z, values_, Evaluator::thread_workspace());
        return values_[static_cast<std::size_t>(output - outputs.begin())];
    }

  private:
    void add_eighths(const Bounds& box, Phase phase, Counts counts, std::vector<Bounds>& kept) {
        const std::array<Bounds, 8> parts = eighths(box);
        const BatchOfFloats distance = distances(centres_of_eighths(box), phase);
        const float radius = circumradius(parts.front());
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (distance[i] <= radius && (counts == Counts::inside_too || distance[i] >= -radius))
                kept.push_back(parts[i]);
    }

    Bounds bounds_;
    Evaluator evaluator_;
    std::vector<BatchOfFloats> values_;
};

// Estimates the brightness of the ball around a box from 64 points in it.
class Brightness {
  public:
    Brightness(PhaseFinder& finder, Phase phase, const Material& material)
        : finder_(finder), phase_(phase), material_(material) {}

    float operator()(const Bounds& box) const {
        const float brightness = std::visit([&](const auto& kind) { return of(kind, box); }, material_);
        return std::max(brightness, least_brightness * most(box));
    }

  private:
    // A flat surface through the box is close to half of the 64 points. A surface that is close to fewer of them, such
    // as that of a rod, fills less of the box.
    float of(const Glowing& glowing, const Bounds& box) const {
        constexpr float places_near_even_surface = 32;
        float near_surface = 0, sum = 0;
        for (const Bounds& eighth : eighths(box)) {
            const PointBatch at = centres_of_eighths(eighth);
            const BatchOfFloats distance = finder_.distances(at, phase_);
            const float radius = circumradius(eighths(eighth).front());
            for (std::size_t i = 0; i < batch_size; ++i) {
                if (!(std::abs(distance[i]) <= radius)) continue;
                ++near_surface;
                sum += luminance(color_at(glowing.light, {at[i], {0, 0, 1}, std::nullopt}));
            }
        }
        return glowing.radiance * sum / std::max(near_surface, places_near_even_surface);
    }
    float of(const Principled& layers, const Bounds& box) const {
        return layers.emission ? of(*layers.emission, box) : 0.0f;
    }
    // The radiance that the medium in the box would emit without absorption, averaged over the ball's cross section,
    // and at most that of an infinitely deep medium.
    float of(const Clear& clear, const Bounds& box) const {
        float inside = 0;
        for (const Bounds& eighth : eighths(box)) {
            const PointBatch at = centres_of_eighths(eighth);
            const BatchOfFloats distance = finder_.distances(at, phase_);
            const auto* varying = std::get_if<VaryingMedium>(&clear.interior);
            const BatchOfFloats brightness = varying ? varying->brightness_at(at) : BatchOfFloats{};
            for (std::size_t i = 0; i < batch_size; ++i)
                if (distance[i] < 0.0f) inside += (varying ? brightness[i] : 1.0f) / 64;
        }
        // The volume of a large box overflows a float.
        const glm::dvec3 extent(box.extent());
        const double radius = 0.5 * static_cast<double>(box.diagonal());
        const double through =
            extent.x * extent.y * extent.z * static_cast<double>(inside) / (std::numbers::pi * radius * radius);
        const glm::vec3 seen =
            glm::min(glm::vec3(static_cast<float>(through)), 1.0f / glm::max(extinction(clear.interior), 1e-30f));
        return luminance(emission(clear.interior) * seen);
    }
    template <class Dark>
    float of(const Dark&, const Bounds&) const {
        return 0.0f;
    }

    // The brightness if the whole box emits.
    float most(const Bounds& box) const {
        if (const Glowing* glowing = emission_of(material_)) return glowing->radiance;
        const Medium& medium = std::get<Clear>(material_).interior;
        return luminance(emission(medium) / glm::max(extinction(medium), 1.0f / box.diagonal()));
    }

    PhaseFinder& finder_;
    Phase phase_;
    const Material& material_;
};

// The extent of the emission: there is none outside this box.
Bounds bounds_of_light(const Material& material) {
    const Clear* clear = std::get_if<Clear>(&material);
    const VaryingMedium* varying = clear ? std::get_if<VaryingMedium>(&clear->interior) : nullptr;
    return varying ? varying->bounds() : Bounds::everything();
}

}  // namespace

std::vector<EmissiveBall> parts_of_phases(const Phased& tree, std::span<const Material> materials) {
    const PhaseSet present = phases(tree);
    std::vector<EmissiveBall> parts;
    std::optional<PhaseFinder> finder;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Phase phase{static_cast<std::uint8_t>(i)};
        if (!is_emissive(materials[i]) || !present.contains(phase)) continue;
        if (!finder) finder.emplace(tree);
        const Counts counts = glows(materials[i]) ? Counts::surface_alone : Counts::inside_too;
        const Brightness brightness(*finder, phase, materials[i]);
        for (const Bounds& box : finder->boxes_of(phase, bounds_of_light(materials[i]), counts))
            parts.push_back(part_in(box, brightness(box),
                                    glows(materials[i]) ? EmissivePart::Of::surface : EmissivePart::Of::medium));
    }
    return parts;
}

}  // namespace phasetree::tracer
