#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

template <class Child>
struct Instances : Copies<Instances<Child>, Child> {
    static constexpr NodeInfo info{
        "instances", "", "min over i of sᵢ φ(R(−aᵢ)(p − vᵢ)/sᵢ); for objects, later copies replace earlier ones",
        "Copies at the given positions, optionally rotated about the z axis and scaled."};
    std::vector<glm::vec3> positions{};
    std::vector<float> turns{};
    std::vector<float> scales{};

    template <class V>
    static void parameters(V&& v) {
        v(&Instances::of, detail::copied);
        v(&Instances::positions, Parameter{"positions", "m", "Positions of the copies' origins."});
        v(&Instances::turns,
          Parameter{"turns", "degrees", "Rotation of each copy about its own z axis; one number applies to all.",
                    limits::any, true, true});
        v(&Instances::scales, Parameter{"scales", "", "Scale factor of each copy; one number applies to all.",
                                        limits::positive, true, true});
    }
    void prepare() const {
        if (positions.size() > static_cast<std::size_t>(detail::max_copies))
            throw ModelError("instances: too many positions");
        const auto fits = [&](const std::vector<float>& list) {
            return list.size() <= 1 || list.size() == positions.size();
        };
        if (!fits(turns) || !fits(scales))
            throw ModelError("instances: \"turns\" and \"scales\" need an entry for each position, or one for all");
        for (std::size_t i = 0; i < many(); ++i) (void)placement(i);  // throws if a scale is too small
    }
    std::size_t many() const { return positions.size(); }
    Placement placement(std::size_t i) const {
        const auto entry = [&](const std::vector<float>& list, float otherwise) {
            return list.empty() ? otherwise : list.size() == 1 ? list[0] : list[i];
        };
        return Placement::at(positions[i], entry(turns, 0), entry(scales, 1));
    }
};

struct FieldInstances : Instances<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedInstances : Instances<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
