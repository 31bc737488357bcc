// The object is divided again and again, each time into boxes half as large, until all statements are decided. All
// earlier divisions together take less time than the last one.
#include "phasetree/measuring/prove.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "measuring/check_statement.hpp"
#include "measuring/decide.hpp"
#include "measuring/loose_bounds.hpp"
#include "measuring/thickness_search.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree {

namespace measuring {

namespace {

using Clock = std::chrono::steady_clock;

class Prover {
  public:
    Prover(const Phased& object, std::span<const Statement> statements, const ProveOptions& options)
        : object_(object),
          statements_(statements),
          options_(options),
          traceable_(prepare_to_trace(object)),
          evaluator_(record(object)),
          start_(Clock::now()),
          proofs_(statements.size()),
          present_(statements.size()),
          is_measured_(statements.size()) {}

    // First coarse volumes, which decide most statements about volumes; then the boxes; then volumes as precisely as
    // necessary. Each stage leaves time for the next.
    std::vector<Proof> run() {
        const FlushSubnormals flush;
        const double for_nodes = has_nodes() ? 0.2 : 0;
        decide_volumes(0.01, 0.25);
        divide((has_open_volume() ? 0.75 : 1) - for_nodes);
        decide_nodes(for_nodes);
        decide_volumes(finest_tolerance, 1);
        if (stopped()) give_up(is_cancelled_ ? "interrupted" : "time ran out");
        give_up("the resolution is too coarse");
        if (options_.progress) options_.progress(1.f);
        return proofs_;
    }

  private:
    // Begins a stage that ends at this share of the time.
    void begin_stage(double share) {
        end_of_stage_ = share * options_.seconds;
        is_stopped_ = is_cancelled_.load();
    }
    bool stopped() {
        if (is_stopped_.load(std::memory_order_relaxed)) return true;
        if (options_.cancelled && options_.cancelled()) is_cancelled_ = is_stopped_ = true;
        if (seconds_left() <= 0) is_stopped_ = true;
        return is_stopped_;
    }
    double seconds_passed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double seconds_left() const { return end_of_stage_ - seconds_passed(); }
    // Reports the share of the statements that are decided, or of the time if that is greater.
    void tell() {
        if (!options_.progress) return;
        const auto decided = static_cast<double>(std::ranges::count_if(
            proofs_, [](const Proof& p) { return p.verdict != Verdict::undecided || !p.reason.empty(); }));
        const double share = std::max(decided / static_cast<double>(std::max<std::size_t>(1, proofs_.size())),
                                      seconds_passed() / options_.seconds);
        if (!(share > told_ + 1.0 / 1024) || share > 1 - 1.0 / 1024) return;
        told_ = share;
        options_.progress(static_cast<float>(share));
    }
    void divide(double share) {
        begin_stage(share);
        const std::function<bool()> is_stopped = [this] { return stopped(); };
        const int last = last_levels(traceable_, options_);
        for (int levels = std::min(first_levels, last); levels <= last && is_any_open(levels) && !stopped(); ++levels) {
            try {
                const PhaseOctree octree = divided(object_, traceable_, levels, options_.max_boxes, is_stopped);
                const Evidence evidence{octree, evaluator_, is_stopped};
                // Walls last: where points are expensive, they may take all of the time.
                for (const bool is_for_walls : {false, true})
                    for (std::size_t i = 0; i < statements_.size() && !stopped(); ++i)
                        if (is_open(i) && std::holds_alternative<IsThick>(statements_[i]) == is_for_walls &&
                            !std::holds_alternative<HasNoDeadNodes>(statements_[i]))
                            decide_one(evidence, i);
            } catch (const DivisionStopped& e) {
                if (e.exceeded_max_boxes) give_up("more boxes are needed than allowed");
                break;
            }
            tell();
        }
        if (stopped()) give_up(is_cancelled_ ? "interrupted" : "time ran out", false);
    }
    bool is_open(std::size_t i) const { return proofs_[i].verdict == Verdict::undecided && proofs_[i].reason.empty(); }
    // Whether boxes can still decide something: a statement that is not about volumes, or whether phases exist. Tight
    // bounds alone are not worth many boxes.
    bool is_any_open(int levels) const {
        constexpr int levels_for_bounds = 7;
        for (std::size_t i = 0; i < statements_.size(); ++i) {
            if (std::holds_alternative<HasTightBounds>(statements_[i]) && levels > levels_for_bounds) continue;
            const auto* volume = std::get_if<HasVolume>(&statements_[i]);
            if (std::holds_alternative<HasNoDeadNodes>(statements_[i])) continue;
            if (is_open(i) && (!volume || !are_present(*volume, present_[i]))) return true;
        }
        return false;
    }
    bool has_open_volume() const {
        for (std::size_t i = 0; i < statements_.size(); ++i)
            if (std::holds_alternative<HasVolume>(statements_[i]) && is_open(i)) return true;
        return false;
    }
    static bool are_present(const HasVolume& s, PhaseSet present) {
        return std::ranges::all_of(s.weights, [&](const auto& w) { return present.contains(w.first); });
    }
    // Later stages can still decide statements about volumes and nodes.
    void give_up(const std::string& reason, bool is_last_stage = true) {
        for (std::size_t i = 0; i < proofs_.size(); ++i) {
            const bool has_later_stage = std::holds_alternative<HasVolume>(statements_[i]) ||
                                         std::holds_alternative<HasNoDeadNodes>(statements_[i]);
            if (is_open(i) && (is_last_stage || !has_later_stage)) proofs_[i].reason = reason;
        }
    }
    void decide_one(const Evidence& evidence, std::size_t i) {
        if (const auto* volume = std::get_if<HasVolume>(&statements_[i])) {
            decide_presence(evidence, *volume, i);
            return;
        }
        Proof proof = std::visit(
            [&]<class S>(const S& statement) {
                if constexpr (std::is_same_v<S, HasVolume> || std::is_same_v<S, HasNoDeadNodes>)
                    return Proof();  // decided by decide_volumes() or decide_nodes()
                else if constexpr (std::is_same_v<S, HasTightBounds>)
                    return decide(evidence, statement, object_);
                else
                    return decide(evidence, statement);
            },
            statements_[i]);
        proof.resolution = evidence.octree.side();
        proofs_[i] = std::move(proof);
    }
    bool has_nodes() const {
        return std::ranges::any_of(statements_,
                                   [](const Statement& s) { return std::holds_alternative<HasNoDeadNodes>(s); });
    }
    // Takes at most this share of the time.
    void decide_nodes(double share) {
        if (!has_nodes()) return;
        begin_stage(share + seconds_passed() / options_.seconds);
        if (stopped()) return;
        NodeEffectsOptions options;
        options.seconds = std::max(seconds_left(), 1e-3);
        options.cancelled = [this] { return stopped(); };
        const std::vector<NodeEffect> nodes = node_effects(object_, options);
        const auto count = [&](Verdict v) { return std::ranges::count(nodes, v, &NodeEffect::is_dead); };
        const auto dead = count(Verdict::proved), open = count(Verdict::undecided);
        Proof proof;
        proof.nodes = nodes;
        proof.verdict = dead > 0 ? Verdict::refuted : open > 0 ? Verdict::undecided : Verdict::proved;
        if (dead > 0) proof.reason = fmt::format("{} of {} nodes change no label", dead, nodes.size());
        if (dead == 0 && open > 0)
            proof.reason =
                fmt::format("for {} of {} nodes, it is not known whether they change a label", open, nodes.size());
        for (std::size_t i = 0; i < statements_.size(); ++i)
            if (std::holds_alternative<HasNoDeadNodes>(statements_[i])) proofs_[i] = proof;
    }
    // Decides whether the phases of a statement about a volume exist, as the statement requires.
    void decide_presence(const Evidence& evidence, const HasVolume& s, std::size_t i) {
        for (const auto& [phase, weight] : s.weights) {
            if (present_[i].contains(phase)) continue;
            Proof proof = decide(evidence, IsPresent{phase});
            if (proof.verdict == Verdict::refuted) {
                proof.measured = proofs_[i].measured;
                proofs_[i] = std::move(proof);
                return;
            }
            if (proof.verdict == Verdict::proved) present_[i] = present_[i] | PhaseSet::of(phase);
        }
        conclude(s, i);
    }
    // Decides from the interval known so far.
    void conclude(const HasVolume& s, std::size_t i) {
        Proof& proof = proofs_[i];
        const Measured& sum = proof.measured;
        if (!is_measured_[i]) return;
        if (sum.high < s.at_least || sum.low > s.at_most) proof.verdict = Verdict::refuted;
        if (sum.low >= s.at_least && sum.high <= s.at_most && are_present(s, present_[i]))
            proof.verdict = Verdict::proved;
    }
    // Decides open statements about volumes. Each gets an equal part of the stage's remaining time.
    void decide_volumes(double tolerance, double share) {
        begin_stage(share);
        std::size_t left = 0;
        for (std::size_t i = 0; i < statements_.size(); ++i)
            left += std::holds_alternative<HasVolume>(statements_[i]) && is_open(i);
        for (std::size_t i = 0; i < statements_.size() && !stopped(); ++i)
            if (const auto* volume = std::get_if<HasVolume>(&statements_[i]); volume && is_open(i))
                decide_volume(*volume, i, tolerance, seconds_left() / static_cast<double>(left--));
    }
    // Measures until the interval is on one side of each limit.
    void decide_volume(const HasVolume& s, std::size_t i, double tolerance, double seconds) {
        PhaseSet wanted;
        for (const auto& [phase, weight] : s.weights) wanted = wanted | PhaseSet::of(phase);
        MeasureOptions options;
        options.tolerance = tolerance;
        options.precise_phases = wanted;
        options.seconds = std::max(seconds, 1e-3);
        options.cancelled = options_.cancelled;
        options.is_enough = [&](const MeasureResult& known) { return is_decided(s, i, known); };
        options.progress = [this](float) { tell(); };
        const MeasureResult measured = measure(object_, options);
        if (is_decided(s, i, measured)) return;
        if (measured.end == MeasureEnd::precision)
            proofs_[i].reason = "32-bit coordinates allow no narrower interval";
        else if (tolerance <= finest_tolerance && measured.end == MeasureEnd::tolerance)
            proofs_[i].reason = "the interval contains the limit";
    }
    // Records the volume, and returns whether it is on one side of each limit. The presence of the phases may still be
    // undecided then.
    bool is_decided(const HasVolume& s, std::size_t i, const MeasureResult& measured) {
        Measured sum{0, 0, 0};
        for (const MeasuredPhase& p : measured.phases)
            for (const auto& [phase, weight] : s.weights)
                if (phase == p.phase) {
                    sum.low += weight * p.body.volume.low;
                    sum.high += weight * p.body.volume.high;
                    sum.estimate += weight * p.body.volume.estimate;
                    if (p.body.volume.low > 0) present_[i] = present_[i] | PhaseSet::of(phase);
                }
        // The rounding errors of at most 64 products and sums.
        sum.low *= 1 - 1e-14;
        sum.high *= 1 + 1e-14;
        proofs_[i].measured = sum;
        is_measured_[i] = true;
        conclude(s, i);
        return proofs_[i].verdict != Verdict::undecided || (sum.low >= s.at_least && sum.high <= s.at_most);
    }

    static constexpr double finest_tolerance = 1e-6;

    const Phased& object_;
    std::span<const Statement> statements_;
    const ProveOptions& options_;
    TraceableObject traceable_;
    Evaluator evaluator_;
    Clock::time_point start_;
    std::vector<Proof> proofs_;
    // For each statement about a volume: the phases that are known to exist, and whether there is an interval.
    std::vector<PhaseSet> present_;
    std::vector<bool> is_measured_;
    double end_of_stage_ = 0;  // in seconds since the start
    double told_ = 0;          // the last progress
    std::atomic<bool> is_stopped_{false}, is_cancelled_{false};
};

}  // namespace

}  // namespace measuring

void check_statement(const Statement& s) {
    std::visit(measuring::CheckStatement(), s);
}

namespace {

void check(const ProveOptions& options) {
    if (!(options.resolution >= 0 && std::isfinite(options.resolution)))
        throw ModelError(fmt::format("the resolution must be a positive number, or 0, but is {}", options.resolution));
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
}

}  // namespace

std::vector<Proof> prove(const Phased& object, std::span<const Statement> statements, const ProveOptions& options) {
    check(options);
    for (const Statement& s : statements) check_statement(s);
    return measuring::Prover(object, statements, options).run();
}

std::vector<WallThickness> wall_thicknesses(const Phased& object, const ProveOptions& options) {
    check(options);
    return measuring::ThicknessSearch(object, options).run();
}

}  // namespace phasetree
