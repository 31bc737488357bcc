#include "bounding/sign_certificate.hpp"

#include <bit>
#include <cmath>

#include "enclosure/enclosure.hpp"
#include "rewriting/threshold.hpp"

namespace phasetree::bounding {

using enclosure::Range;
using kernel::most_certificate_steps;
using program::ProgramOutput;
using rewriting::Threshold;

namespace {

constexpr double unknown = 1e30;

/// The upper half of a float's bits, of a number that is no smaller, or none that is larger.
std::uint16_t half_at_least(float x) {
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(x) + 0xffffu) >> 16);
}
std::uint16_t half_at_most(float x) {
    return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(x) >> 16);
}

class Certifier {
  public:
    Certifier(const WorkingProgram& program, std::span<const float> constants, const Enclosure* registers,
              std::span<const std::uint32_t> slot, std::span<CertificateStep> room)
        : program_(program), constants_(constants), registers_(registers), slot_(slot), room_(room) {}

    /// That sign · (v − τ) > 0. False if that takes too many steps.
    bool add(std::uint32_t v, double sign, double tau) {
        const Instruction& in = program_.code[v];
        const Range& curvature = registers_[slot_[v]].curvature;
        if (std::abs(curvature.low) < unknown || std::abs(curvature.high) < unknown) return leaf(v, sign, tau);
        if (const auto now = Threshold::of_operand(in, constants_, tau))
            return add(in.a, now->is_mirrored ? -sign : sign, now->tau);
        const bool is_above = sign > 0;
        switch (in.op) {
            case Op::minimum:
            case Op::far_bound_inside:
                return both(in, sign, tau, is_above ? PackedCertificateStep::both : PackedCertificateStep::either);
            case Op::maximum:
            case Op::far_bound:
                return both(in, sign, tau, is_above ? PackedCertificateStep::either : PackedCertificateStep::both);
            case Op::corner:
                // Up to 0 it is the maximum; above, no less than each.
                if (tau <= 0)
                    return both(in, sign, tau, is_above ? PackedCertificateStep::either : PackedCertificateStep::both);
                return is_above ? both(in, sign, tau, PackedCertificateStep::either_one_way) : leaf(v, sign, tau);
            case Op::smooth_minimum:
                // No more than each.
                return is_above ? leaf(v, sign, tau) : both(in, sign, tau, PackedCertificateStep::either_one_way);
            case Op::absolute:
                if (tau < 0) return leaf(v, sign, tau);
                return add(in.a, sign, tau) && add(in.a, -sign, -tau) &&
                       push({is_above ? PackedCertificateStep::either : PackedCertificateStep::both});
            default:
                return leaf(v, sign, tau);
        }
    }
    std::span<const CertificateStep> result() const {
        return is_any_known_ ? room_.first(count_) : std::span<const CertificateStep>();
    }

  private:
    bool push(const CertificateStep& part) {
        if (count_ == room_.size()) return false;
        room_[count_++] = part;
        return true;
    }
    /// Of both operands, combined.
    bool both(const Instruction& in, double sign, double tau, PackedCertificateStep::Kind kind) {
        return add(in.a, sign, tau) && add(in.b, sign, tau) && push({kind});
    }
    bool leaf(std::uint32_t v, double sign, double tau) {
        const Range& c = registers_[slot_[v]].curvature;
        const double factor = 1 / std::max(1.0, static_cast<double>(program_.lipschitz[v]));
        const auto bend = [&](double most) {
            return most < unknown ? static_cast<float>(std::max(most, 0.0) * factor) * (1 + 1e-3f) : Bounds::infinity;
        };
        const float up = bend(c.high), down = bend(-c.low);
        is_any_known_ = is_any_known_ || up < Bounds::infinity || down < Bounds::infinity;
        const bool is_above = sign > 0;
        return push({PackedCertificateStep::leaf, v, static_cast<float>(tau), static_cast<float>(sign * factor),
                     is_above ? up : down, is_above ? down : up});
    }

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Enclosure* registers_;
    std::span<const std::uint32_t> slot_;
    std::span<CertificateStep> room_;
    std::size_t count_ = 0;
    bool is_any_known_ = false;
};

}  // namespace

PackedCertificateStep CertificateStep::step(std::uint32_t slot) const {
    return {threshold,         slot & 0x3fffffffu, static_cast<std::uint32_t>(kind) & 3u, half_at_most(factor),
            half_at_least(up), half_at_least(down)};
}

std::span<const CertificateStep> certify_sign(const WorkingProgram& program, std::span<const float> constants,
                                              const Enclosure* registers, std::span<const std::uint32_t> slot,
                                              Arena& scratch) {
    Certifier prover(program, constants, registers, slot, scratch.take<CertificateStep>(most_certificate_steps));
    const ProgramOutput& first = program.outputs[0];
    return prover.add(first.value, first.negate ? 1 : -1, 0) ? prover.result() : std::span<const CertificateStep>();
}

}  // namespace phasetree::bounding
