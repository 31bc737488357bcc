#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "embree_core/object_instance.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::embree {

/// The phases that a ray is in, one for each object: the media that it carries from hit to hit. Objects may overlap; a
/// hit changes the phase of its own object and of no other.
class RayPhases {
  public:
    /// The ray carries nothing: every object takes the phase at the ray's start, which costs an evaluation and is not
    /// certain within a resolution of an interface.
    RayPhases() = default;
    /// The ray is in this phase of all objects that set() does not list: vacuum, say, where it starts outside of all.
    explicit RayPhases(std::optional<Phase> elsewhere) : elsewhere_(elsewhere) {}

    /// The phase for an object; nothing where it is that at the ray's start.
    std::optional<Phase> of(const ObjectInstance& object) const {
        for (std::size_t i = 0; i < std::min(count_, few); ++i)
            if (first_[i].object == object) return first_[i].phase;
        for (const Medium& medium : more_)
            if (medium.object == object) return medium.phase;
        return elsewhere_;
    }
    /// From here on the ray is in this phase of an object.
    void set(const ObjectInstance& object, Phase phase) {
        for (std::size_t i = 0; i < count_; ++i) {
            Medium& medium = i < few ? first_[i] : more_[i - few];
            if (medium.object == object) {
                medium.phase = phase;
                return;
            }
        }
        if (count_ < few)
            first_[count_] = {object, phase};
        else
            more_.push_back({object, phase});
        ++count_;
    }

  private:
    struct Medium {
        ObjectInstance object;
        Phase phase;
    };
    /// A ray is seldom within more objects at once; so many cost no allocation.
    static constexpr std::size_t few = 4;

    std::optional<Phase> elsewhere_;
    std::size_t count_ = 0;
    std::array<Medium, few> first_{};
    std::vector<Medium> more_;
};

}  // namespace phasetree::embree
