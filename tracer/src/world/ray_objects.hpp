// The objects that contain a ray in a scene with several, with its phase in each, and the ray's time. Outside of all
// objects, a ray is in vacuum.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

/// Copies of objects by increasing numbers (scene/placed.hpp). Usually a ray is in one or none. It is briefly in two
/// where objects touch, and in more only where they overlap, which they should not. If there are more than `most`, the
/// last ones are dropped.
class RayObjects {
  public:
    static constexpr std::size_t most = 4;

    /// No objects, at a share of the shutter interval.
    explicit RayObjects(float time) : time_(time) {}
    RayObjects() = default;

    float time() const { return time_; }
    std::size_t size() const { return size_; }
    std::uint32_t copy(std::size_t i) const { return copies_[i]; }
    Phase phase(std::size_t i) const { return phases_[i]; }
    /// The phase of a ray: where objects overlap, that of the first one.
    Phase phase() const { return size_ > 0 ? phases_[0] : phasetree::vacuum; }

    /// Sets the phase of the ray in a copy.
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

/// A ray from an interface starts at one end of its bracket, which is in its phase. Scene coordinates may round that
/// away, so the ray also has its origin in the coordinates of the copy.
struct StartInCopy {
    std::uint32_t copy = 0;
    glm::vec3 origin{0};
};

}  // namespace phasetree::tracer
