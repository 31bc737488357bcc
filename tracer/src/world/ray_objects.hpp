// The objects that a ray is in, of a scene that has several, with its phase in each, and the time at which it meets
// them. Elsewhere a ray is in vacuum.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// Copies of objects by their numbers (scene/placed.hpp), rising. Mostly a ray is in one or none; it is in two for a
/// moment where objects touch, and in more only where they overlap, which they should not. Of more than `most` the
/// last are forgotten.
class RayObjects {
  public:
    static constexpr std::size_t most = 4;

    /// None, at a share of the time in which the shutter is open.
    explicit RayObjects(float time) : time_(time) {}
    RayObjects() = default;

    float time() const { return time_; }
    std::size_t size() const { return size_; }
    std::uint32_t copy(std::size_t i) const { return copies_[i]; }
    Phase phase(std::size_t i) const { return phases_[i]; }
    /// The phase of a ray: where objects overlap, the first of them is there.
    Phase phase() const { return size_ > 0 ? phases_[0] : phasetree::vacuum; }

    /// From here on the ray is in this phase of a copy.
    void set(std::uint32_t copy, Phase phase) {
        std::size_t i = 0;
        while (i < size_ && copies_[i] < copy) ++i;
        const bool is_there = i < size_ && copies_[i] == copy;
        if (phase == phasetree::vacuum) {
            if (is_there) erase(i);
        } else if (is_there) {
            phases_[i] = phase;
        } else if (i < most) {
            insert(i, copy, phase);
        }
    }

  private:
    void erase(std::size_t i) {
        for (--size_; i < size_; ++i) move(i + 1, i);
    }
    void insert(std::size_t at, std::uint32_t copy, Phase phase) {
        if (size_ < most) ++size_;
        for (std::size_t i = size_ - 1; i > at; --i) move(i - 1, i);
        copies_[at] = copy;
        phases_[at] = phase;
    }
    void move(std::size_t from, std::size_t to) {
        copies_[to] = copies_[from];
        phases_[to] = phases_[from];
    }

    std::array<std::uint32_t, most> copies_{};
    std::array<Phase, most> phases_{};
    std::uint8_t size_ = 0;
    float time_ = 0;
};

/// A ray that starts at an interface starts at one end of its bracket, which is in its phase. The world's coordinates
/// may round that away, so the ray also has it in the coordinates of the copy.
struct StartInCopy {
    std::uint32_t copy = 0;
    glm::vec3 origin{0};
};

}  // namespace phasetree::tracer
