#include "bounding/sign_certificate.hpp"

#include <bit>
#include <cmath>

#include "enclosure/enclosure.hpp"
#include "rewriting/threshold.hpp"

namespace phasetree::bounding {

using enclosure::Interval;
using kernel::most_certificate_steps;
using program::ProgramOutput;
using rewriting::Threshold;

namespace {

// Curvatures of at least this size count as unbounded.
constexpr double unbounded = 1e30;

// The upper half of a float's bits, rounded up.
std::uint16_t upper_half_rounded_up(float x) {
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(x) + 0xffffu) >> 16);
}
// The upper half of a float's bits, rounded toward zero.
std::uint16_t upper_half_rounded_down(float x) {
    return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(x) >> 16);
}

// Writes the steps of a certificate by recursion from a value to its operands.
class Certifier {
  public:
    Certifier(const EnclosedProgram& enclosed, std::span<CertificateStep> room) : enclosed_(enclosed), room_(room) {}

    // Appends a certificate that sign · (v − τ) > 0. False if there is no room for it.
    bool add(std::uint32_t v, double sign, double tau) {
        const Instruction& in = enclosed_.program.code[v];
        const Interval& curvature = enclosed_[v].curvature;
        if (std::abs(curvature.low) < unbounded || std::abs(curvature.high) < unbounded) return add_leaf(v, sign, tau);
        if (const auto operand = Threshold::of_operand(in, enclosed_.constants(), tau))
            return add(in.a, operand->is_reversed ? -sign : sign, operand->tau);
        const bool is_above = sign > 0;
        switch (in.op) {
            case Op::minimum:
            case Op::far_bound_inside:
                return add_operands(in, sign, tau,
                                    is_above ? PackedCertificateStep::both : PackedCertificateStep::either);
            case Op::maximum:
            case Op::far_bound:
                return add_operands(in, sign, tau,
                                    is_above ? PackedCertificateStep::either : PackedCertificateStep::both);
            case Op::corner:
                // Up to 0 it equals the maximum; above 0 it is at least as large as either operand.
                if (tau <= 0)
                    return add_operands(in, sign, tau,
                                        is_above ? PackedCertificateStep::either : PackedCertificateStep::both);
                return is_above ? add_operands(in, sign, tau, PackedCertificateStep::either_one_way)
                                : add_leaf(v, sign, tau);
            case Op::smooth_minimum:
                // It is at most as large as either operand.
                return is_above ? add_leaf(v, sign, tau)
                                : add_operands(in, sign, tau, PackedCertificateStep::either_one_way);
            case Op::absolute:
                if (tau < 0) return add_leaf(v, sign, tau);
                return add(in.a, sign, tau) && add(in.a, -sign, -tau) &&
                       push({is_above ? PackedCertificateStep::either : PackedCertificateStep::both});
            default:
                return add_leaf(v, sign, tau);
        }
    }
    std::span<const CertificateStep> result() const {
        return has_bounded_leaf_ ? room_.first(count_) : std::span<const CertificateStep>();
    }

  private:
    bool push(const CertificateStep& step) {
        if (count_ == room_.size()) return false;
        room_[count_++] = step;
        return true;
    }
    bool add_operands(const Instruction& in, double sign, double tau, PackedCertificateStep::Kind kind) {
        return add(in.a, sign, tau) && add(in.b, sign, tau) && push({kind});
    }
    bool add_leaf(std::uint32_t v, double sign, double tau) {
        const Interval& curvature = enclosed_[v].curvature;
        // The kernel needs 1-Lipschitz leaves, so steeper values are scaled down.
        const double factor = 1 / std::max(1.0, static_cast<double>(enclosed_.program.lipschitz[v]));
        const auto bound = [&](double upward) {
            return upward < unbounded ? static_cast<float>(std::max(upward, 0.0) * factor) * (1 + 1e-3f)
                                      : Bounds::infinity;
        };
        const float up = bound(curvature.high), down = bound(-curvature.low);
        has_bounded_leaf_ = has_bounded_leaf_ || up < Bounds::infinity || down < Bounds::infinity;
        // With the sign −1, the leaf is minus the value, so the bounds of its second derivatives are exchanged.
        const bool is_above = sign > 0;
        return push({PackedCertificateStep::leaf, v, static_cast<float>(tau), static_cast<float>(sign * factor),
                     is_above ? up : down, is_above ? down : up});
    }

    const EnclosedProgram& enclosed_;
    std::span<CertificateStep> room_;
    std::size_t count_ = 0;
    bool has_bounded_leaf_ = false;
};

}  // namespace

PackedCertificateStep CertificateStep::packed(std::uint32_t slot) const {
    return {threshold,
            slot & 0x3fffffffu,
            static_cast<std::uint32_t>(kind) & 3u,
            upper_half_rounded_down(factor),
            upper_half_rounded_up(up),
            upper_half_rounded_up(down)};
}

std::span<const CertificateStep> certify_sign(const EnclosedProgram& enclosed, Arena& scratch) {
    Certifier certifier(enclosed, scratch.allocate<CertificateStep>(most_certificate_steps));
    const ProgramOutput& first = enclosed.program.outputs[0];
    return certifier.add(first.value, first.negate ? 1 : -1, 0) ? certifier.result()
                                                                : std::span<const CertificateStep>();
}

}  // namespace phasetree::bounding
