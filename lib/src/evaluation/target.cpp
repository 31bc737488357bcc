#include "evaluation/target.hpp"

#include <fmt/format.h>
#include <hwy/targets.h>
#include <atomic>
#include <stdexcept>

namespace phasetree {

using evaluation::active_kernel;
using kernel::Kernel;

namespace {

struct Target {
    const char* name;
    const Kernel* kernel;
    bool supported;
};

// The kernels that this machine can run, fastest first. Highway detects what the machine supports, and honours
// hwy::DisableTargets.
std::vector<Target> detect_targets() {
    const auto machine = static_cast<std::int64_t>(hwy::SupportedTargets());
    const auto has = [&](std::int64_t target) { return (machine & target) != 0; };
    std::vector<Target> all;
#ifdef PHASETREE_X86
    all.push_back({"AVX-512", &kernel::kernel_avx512, has(HWY_AVX3)});
    all.push_back({"AVX2", &kernel::kernel_avx2, has(HWY_AVX2)});
    all.push_back({"SSE4", &kernel::kernel_sse4, has(HWY_SSE4)});
    all.push_back({"SSE2", &kernel::kernel_baseline, true});
#else
    (void)has;
    all.push_back({"baseline", &kernel::kernel_baseline, true});
#endif
    std::erase_if(all, [](const Target& t) { return !t.supported; });
    return all;
}

// Detected once: the CPUID instruction is slow in virtual machines.
const std::vector<Target>& targets() {
    static const std::vector<Target> all = detect_targets();
    return all;
}

// The kernel in use by the whole process; null until first use. It affects only speed, never results.
std::atomic<const Kernel*> chosen{nullptr};

}  // namespace

const Kernel& evaluation::active_kernel() {
    const Kernel* k = chosen.load(std::memory_order_relaxed);
    if (!k) {
        k = targets().front().kernel;
        chosen.store(k, std::memory_order_relaxed);
    }
    return *k;
}

std::vector<std::string> simd_targets() {
    std::vector<std::string> names;
    for (const Target& t : targets()) names.emplace_back(t.name);
    return names;
}

std::string simd_target() {
    for (const Target& t : targets())
        if (t.kernel == &active_kernel()) return t.name;
    return "none";
}

void use_simd_target(std::string_view name) {
    for (const Target& t : targets()) {
        if (name == t.name) {
            chosen.store(t.kernel, std::memory_order_relaxed);
            return;
        }
    }
    throw std::invalid_argument(fmt::format("this machine does not support the SIMD target \"{}\"", name));
}

}  // namespace phasetree
