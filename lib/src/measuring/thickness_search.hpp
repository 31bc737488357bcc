#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "measuring/decide.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::measuring {

/// Finds the thickness at which IsThick changes from proved to refuted.
class ThicknessSearch {
  public:
    ThicknessSearch(const Phased& object, const ProveOptions& options)
        : object_(object),
          options_(options),
          traceable_(prepare_to_trace(object)),
          evaluator_(record(object)),
          start_(std::chrono::steady_clock::now()) {
        for_each_phase(phases(object).bits & ~PhaseSet::of(vacuum).bits,
                       [&](int i) { found_.push_back({Phase{static_cast<std::uint8_t>(i)}}); });
    }

    std::vector<WallThickness> run() {
        const FlushSubnormals flush;
        const int last = last_levels(traceable_, options_);
        const std::function<bool()> is_stopped = [this] { return stopped(); };
        const auto is_open = [](const WallThickness& w) { return !(w.high <= close_enough * w.low); };
        for (int levels = std::min(first_levels, last); levels <= last && !stopped(); ++levels) {
            if (std::ranges::none_of(found_, is_open)) break;
            try {
                const PhaseOctree octree = divided(object_, traceable_, levels, options_.max_boxes, is_stopped);
                const Evidence evidence{octree, evaluator_, is_stopped};
                for (WallThickness& w : found_)
                    if (is_open(w) && !stopped()) search(evidence, w);
            } catch (const DivisionStopped&) {
                break;
            }
            tell(std::ldexp(1.0, 2 * (levels - last)));
        }
        if (options_.progress) options_.progress(1.f);
        return found_;
    }

  private:
    static constexpr double close_enough = 1.05;

    double seconds_passed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    bool stopped() {
        if (options_.cancelled && options_.cancelled()) is_stopped_ = true;
        if (seconds_passed() >= options_.seconds) is_stopped_ = true;
        return is_stopped_;
    }
    // Reports this share of the boxes, or the share of the time if that is greater.
    void tell(double share) {
        share = std::max(share, seconds_passed() / options_.seconds);
        if (!options_.progress || !(share > told_ + 1.0 / 1024) || share > 1 - 1.0 / 1024) return;
        told_ = share;
        options_.progress(static_cast<float>(share));
    }
    Verdict attempt(const Evidence& e, WallThickness& w, double thickness) {
        tell(0);
        const Proof proof = decide(e, IsThick{w.phase, thickness});
        if (proof.verdict == Verdict::proved) w.low = std::max(w.low, thickness);
        if (proof.verdict == Verdict::refuted && !proof.witnesses.empty() && thickness < w.high) {
            w.high = thickness;
            w.place = proof.witnesses.front().point;
        }
        return proof.verdict;
    }
    // First upwards, until a thickness is refuted. Then both ends move towards each other as far as these boxes allow.
    void search(const Evidence& e, WallThickness& w) {
        if (e.is_absent(w.phase)) return;
        constexpr double growth = 1.4;
        const double longest = 2 * e.octree.whole().half_diagonal();
        for (double t = w.low > 0 ? w.low * growth : 2 * e.octree.side(); t < std::min(w.high, longest); t *= growth)
            if (stopped() || attempt(e, w, t) == Verdict::refuted) break;
        for (const Verdict wanted : {Verdict::proved, Verdict::refuted}) {
            constexpr int most_steps = 4;
            double low = std::max(w.low, e.octree.side()), high = w.high;
            for (int step = 0; step < most_steps && std::isfinite(high) && high > close_enough * low; ++step) {
                if (stopped()) return;
                const double middle = std::sqrt(low * high);
                const bool is_wanted = attempt(e, w, middle) == wanted;
                (is_wanted == (wanted == Verdict::proved) ? low : high) = middle;
            }
        }
    }

    const Phased& object_;
    const ProveOptions& options_;
    TraceableObject traceable_;
    Evaluator evaluator_;
    std::chrono::steady_clock::time_point start_;
    std::vector<WallThickness> found_;
    double told_ = 0;  // the last progress
    std::atomic<bool> is_stopped_{false};
};

}  // namespace phasetree::measuring
