#include "support/set_algebra.hpp"

#include "support/set_algebra/all.hpp"

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
