#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "embree_core/object_instance.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::embree {

/// The phase of one object that a ray is in and carries from hit to hit.
struct CarriedPhase {
    ObjectInstance object;
    Phase phase;
};

/// The phases that a ray is in, one per object, carried from hit to hit. Objects may overlap; a hit changes only the
/// phase of its own object.
class RayPhases {
  public:
    /// A ray that carries nothing. Every object uses the phase at the ray's start, which costs an evaluation and is
    /// uncertain within a resolution of an interface.
    RayPhases() = default;
    /// A ray that is in this phase in each object for which set() is not called. For a ray that starts outside all
    /// objects, pass the vacuum.
    explicit RayPhases(std::optional<Phase> default_phase) : default_phase_(default_phase) {}

    /// The phase for an object; nullopt for the phase at the ray's start.
    std::optional<Phase> of(const ObjectInstance& object) const { return find(carried_, default_phase_, object); }
    /// Set the phase of an object.
    void set(const ObjectInstance& object, Phase phase) {
        const auto known = std::ranges::find(carried_, object, &CarriedPhase::object);
        if (known == carried_.end())
            carried_.push_back({object, phase});
        else
            known->phase = phase;
    }

    std::span<const CarriedPhase> carried() const { return carried_; }
    std::optional<Phase> default_phase() const { return default_phase_; }

    /// The carried phase of an object, or `default_phase` if there is none.
    static std::optional<Phase> find(std::span<const CarriedPhase> carried, std::optional<Phase> default_phase,
                                     const ObjectInstance& object) {
        for (const CarriedPhase& known : carried)
            if (known.object == object) return known.phase;
        return default_phase;
    }

  private:
    std::vector<CarriedPhase> carried_;
    std::optional<Phase> default_phase_;
};

}  // namespace phasetree::embree
