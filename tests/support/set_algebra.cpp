#include "support/set_algebra.hpp"

#include "support/set_algebra/balls.hpp"
#include "support/set_algebra/blobs.hpp"
#include "support/set_algebra/components.hpp"
#include "support/set_algebra/copies.hpp"
#include "support/set_algebra/field_operators.hpp"
#include "support/set_algebra/formulas.hpp"
#include "support/set_algebra/meshes.hpp"
#include "support/set_algebra/outlines.hpp"
#include "support/set_algebra/patterns.hpp"
#include "support/set_algebra/primitives.hpp"
#include "support/set_algebra/proxies.hpp"
#include "support/set_algebra/regions.hpp"
#include "support/set_algebra/textures.hpp"
#include "support/set_algebra/volumes.hpp"
#include "support/set_algebra/warps.hpp"

namespace phasetree::tests {

bool inside(const Field& f, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::member(n, p); }, f.node()->node);
}
Phase label(const Phased& a, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::region(n, p); }, a.node()->node);
}
double value(const Field& f, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::signed_value(n, p); }, f.node()->node);
}
Components values(const Phased& a, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::components(n, p); }, a.node()->node);
}

}  // namespace phasetree::tests
