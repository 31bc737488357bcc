// The list of all media, and a medium of any kind by value.
#pragma once

#include <variant>

#include "media/absorbing.hpp"
#include "media/contract.hpp"

namespace phasetree::tracer {

/// A kind of medium, once its contract has been asked of it. If it does not meet that, the message names the kind and
/// the member.
template <class Kind>
struct CheckedMedium {
    static_assert(MediumKind<Kind>);
    using Type = Kind;
};

template <class... Kinds>
using MediumOf = std::variant<typename CheckedMedium<Kinds>::Type...>;

/// Every kind of medium. The first is the default, and lets everything pass as long as nothing else is said.
using Medium = MediumOf<AbsorbingMedium>;

/// MediumKind's transmittance of a medium of any kind.
inline glm::vec3 transmittance(const Medium& medium, float distance) {
    return std::visit([&](const auto& kind) { return kind.transmittance(distance); }, medium);
}

}  // namespace phasetree::tracer
