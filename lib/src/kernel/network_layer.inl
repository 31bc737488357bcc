// A linear layer of a neural network with several numbers per neuron: a Taylor polynomial and its error bounds
// (bounding/network_in_box.hpp). Included by kernel.inl.

namespace phasetree::kernel::HWY_NAMESPACE {
namespace {

using Doubles = hn::CappedTag<double, 8>;
constexpr std::size_t double_lanes = hn::MaxLanes(Doubles());
constexpr std::size_t neuron_registers = network_lanes / double_lanes;

// Computes `count` outputs at a time: each addition of a single sum would have to wait for the previous one.
template <std::size_t count>
HWY_INLINE void outputs_of_layer(const float* weights, const float* bias, std::size_t inputs, const double* in,
                                 double* out) {
    constexpr std::size_t mixed = absolute_lane / double_lanes;  // the register in which the lanes that use |W| begin
    const Doubles tag;
    const auto is_plain = hn::FirstN(tag, absolute_lane % double_lanes), is_value = hn::FirstN(tag, 1);
    hn::Vec<Doubles> sum[count][neuron_registers];
    for (std::size_t o = 0; o < count; ++o) {
        for (std::size_t k = 0; k < neuron_registers; ++k) sum[o][k] = hn::Zero(tag);
        sum[o][0] = hn::IfThenElse(is_value, hn::Set(tag, static_cast<double>(bias[o])), sum[o][0]);
    }
    for (std::size_t i = 0; i < inputs; ++i, in += network_lanes) {
#pragma GCC unroll 4
        for (std::size_t o = 0; o < count; ++o) {
            const auto w = hn::Set(tag, static_cast<double>(weights[o * inputs + i])), most = hn::Abs(w);
#pragma GCC unroll 12
            for (std::size_t k = 0; k < neuron_registers; ++k) {
                const auto by = k < mixed ? w : k > mixed ? most : hn::IfThenElse(is_plain, w, most);
                sum[o][k] = hn::Add(sum[o][k], hn::Mul(by, hn::Load(tag, in + k * double_lanes)));
            }
        }
    }
    for (std::size_t o = 0; o < count; ++o)
        for (std::size_t k = 0; k < neuron_registers; ++k)
            hn::Store(sum[o][k], tag, out + o * network_lanes + k * double_lanes);
}

// out = W·in + bias, with `network_lanes` doubles per neuron. The bias is added to the first of them. Those from
// `absolute_lane` on are error bounds, which are summed with |W| instead of W. The order of summation follows the
// inputs, and is the same for every instruction set.
HWY_FLATTEN void network_layer(const float* weights, const float* bias, std::size_t inputs, std::size_t outputs,
                               const double* in, double* out) {
    constexpr std::size_t together = neuron_registers > 6   ? 1
                                     : neuron_registers > 3 ? 2
                                                            : 4;  // as many as the registers hold
    std::size_t o = 0;
    for (; o + together <= outputs; o += together)
        outputs_of_layer<together>(weights + o * inputs, bias + o, inputs, in, out + o * network_lanes);
    for (; o < outputs; ++o) outputs_of_layer<1>(weights + o * inputs, bias + o, inputs, in, out + o * network_lanes);
}

}  // namespace
}  // namespace phasetree::kernel::HWY_NAMESPACE
