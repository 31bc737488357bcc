// The object is divided again and again, each time into boxes half as large, until all statements are decided. All
// earlier divisions together take less time than the last one.
#include "phasetree/measuring/prove.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "measuring/decide.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree {

namespace measuring {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int first_levels = 5;
constexpr double boxes_along_longest_side = 256;

class Prover {
  public:
    Prover(const Phased& object, std::span<const Statement> statements, const ProveOptions& options)
        : object_(object),
          statements_(statements),
          options_(options),
          traceable_(prepare_to_trace(object)),
          evaluator_(record(object)),
          start_(Clock::now()),
          proofs_(statements.size()) {}

    std::vector<Proof> run() {
        const FlushSubnormals flush;
        const std::function<bool()> is_stopped = [this] { return stopped(); };
        for (std::size_t i = 0; i < statements_.size(); ++i)
            if (const auto* volume = std::get_if<HasVolume>(&statements_[i])) proofs_[i] = decide_volume(*volume);
        const int last = levels_for(traceable_, side());
        for (int levels = std::min(first_levels, last); levels <= last && is_any_open() && !stopped(); ++levels) {
            try {
                const PhaseOctree octree = divided(object_, traceable_, levels, options_.max_boxes, is_stopped);
                const Evidence evidence{octree, evaluator_, is_stopped};
                for (std::size_t i = 0; i < statements_.size() && !stopped(); ++i)
                    if (proofs_[i].verdict == Verdict::undecided) decide_one(evidence, i);
            } catch (const DivisionStopped& e) {
                give_up(e.is_for_boxes ? "more boxes are needed than allowed" : "");
                break;
            }
            if (options_.progress) options_.progress(std::ldexp(1.0f, 2 * (levels - last)));
        }
        if (stopped()) give_up(is_cancelled_ ? "interrupted" : "time ran out");
        give_up("the resolution is too coarse");
        if (options_.progress) options_.progress(1.f);
        return proofs_;
    }

  private:
    bool stopped() {
        if (is_stopped_.load(std::memory_order_relaxed)) return true;
        if (options_.cancelled && options_.cancelled()) is_cancelled_ = is_stopped_ = true;
        if (seconds_left() <= 0) is_stopped_ = true;
        return is_stopped_;
    }
    double seconds_left() const {
        return options_.seconds - std::chrono::duration<double>(Clock::now() - start_).count();
    }
    double side() const {
        if (options_.resolution > 0) return options_.resolution;
        const glm::dvec3 extent(traceable_.bounds.extent());
        return std::max({extent.x, extent.y, extent.z}) / boxes_along_longest_side;
    }
    bool is_any_open() const {
        return std::ranges::any_of(proofs_,
                                   [](const Proof& p) { return p.verdict == Verdict::undecided && p.reason.empty(); });
    }
    void give_up(const std::string& reason) {
        for (Proof& proof : proofs_)
            if (proof.verdict == Verdict::undecided && proof.reason.empty()) proof.reason = reason;
    }
    void decide_one(const Evidence& evidence, std::size_t i) {
        Proof proof = std::visit(
            [&]<class S>(const S& statement) {
                if constexpr (std::is_same_v<S, HasVolume>)
                    return proofs_[i];
                else
                    return decide(evidence, statement);
            },
            statements_[i]);
        proof.resolution = evidence.octree.side();
        proofs_[i] = std::move(proof);
    }
    // Measures more and more precisely until the interval is on one side of each limit.
    Proof decide_volume(const HasVolume& s) {
        Proof proof;
        constexpr double finest = 1e-7;
        for (double tolerance = 0.1; tolerance > finest && !stopped(); tolerance /= 10) {
            MeasureOptions options;
            options.tolerance = tolerance;
            options.seconds = std::max(seconds_left(), 1e-3);
            options.cancelled = options_.cancelled;
            const MeasureResult measured = measure(object_, options);
            Measured sum{0, 0, 0};
            for (const MeasuredPhase& p : measured.phases)
                for (const auto& [phase, weight] : s.weights)
                    if (phase == p.phase) {
                        sum.low += weight * p.body.volume.low;
                        sum.high += weight * p.body.volume.high;
                        sum.estimate += weight * p.body.volume.estimate;
                    }
            // The rounding errors of at most 64 products and sums.
            sum.low *= 1 - 1e-14;
            sum.high *= 1 + 1e-14;
            proof.measured = sum;
            if (sum.low >= s.at_least && sum.high <= s.at_most) proof.verdict = Verdict::proved;
            if (sum.high < s.at_least || sum.low > s.at_most) proof.verdict = Verdict::refuted;
            if (proof.verdict != Verdict::undecided) return proof;
            if (measured.end == MeasureEnd::precision) {
                proof.reason = "32-bit coordinates allow no narrower interval";
                return proof;
            }
        }
        proof.reason = stopped() ? "" : "the interval contains the limit";
        return proof;
    }

    const Phased& object_;
    std::span<const Statement> statements_;
    const ProveOptions& options_;
    TraceableObject traceable_;
    Evaluator evaluator_;
    Clock::time_point start_;
    std::vector<Proof> proofs_;
    std::atomic<bool> is_stopped_{false}, is_cancelled_{false};
};

// Rejects statements about phases that cannot be meant, and lengths out of their ranges.
struct CheckStatement {
    void phase(Phase p) const {
        if (p.index >= Phase::capacity) throw ModelError(fmt::format("there is no phase {}", p.index));
    }
    void different(Phase a, Phase b) const {
        phase(a);
        phase(b);
        if (a == b) throw ModelError("the two phases of a statement must differ");
    }
    void length(double v, bool is_zero_allowed, const char* what) const {
        if (!(v >= 0 && std::isfinite(v) && (is_zero_allowed || v > 0)))
            throw ModelError(fmt::format("{} must be {} number, but is {}", what,
                                         is_zero_allowed ? "a finite, not negative" : "a finite, positive", v));
    }
    void operator()(const IsPresent& s) const { phase(s.phase); }
    void operator()(const IsConnected& s) const { phase(s.phase); }
    void operator()(const IsClosed& s) const {
        if (s.walls.empty() || s.inside.empty()) throw ModelError("\"closed\" needs walls, and phases inside them");
        if (!(s.walls & s.inside).empty()) throw ModelError("a phase cannot be both a wall and inside the walls");
        if ((s.walls | s.inside).contains(vacuum))
            throw ModelError("the vacuum surrounds the object, so it is neither a wall nor inside walls");
    }
    void operator()(const AreApart& s) const {
        different(s.first, s.second);
        length(s.at_least, true, "the distance");
    }
    void operator()(const AreTouching& s) const { different(s.first, s.second); }
    void operator()(const IsThick& s) const {
        phase(s.phase);
        if (s.phase == vacuum) throw ModelError("the vacuum has no walls");
        length(s.at_least, false, "the thickness");
        length(s.reach, true, "the reach");
        if (s.reach > 0 && !(s.reach > 0.5 * s.at_least))
            throw ModelError(fmt::format("the reach must be more than half of the thickness, {}, but is {}",
                                         0.5 * s.at_least, s.reach));
    }
    void operator()(const HasVolume& s) const {
        for (const auto& [p, weight] : s.weights) {
            phase(p);
            if (p == vacuum) throw ModelError("the vacuum has no volume");
            length(weight, true, "a weight");
        }
        if (!(s.at_least <= s.at_most)) throw ModelError("the least volume must not be more than the greatest");
    }
};

}  // namespace

}  // namespace measuring

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::proved:
            return "proved";
        case Verdict::refuted:
            return "refuted";
        case Verdict::undecided:
            return "undecided";
    }
    return "";
}

std::vector<Proof> prove(const Phased& object, std::span<const Statement> statements, const ProveOptions& options) {
    if (!(options.resolution >= 0 && std::isfinite(options.resolution)))
        throw ModelError(fmt::format("the resolution must be a positive number, or 0, but is {}", options.resolution));
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
    for (const Statement& s : statements) std::visit(measuring::CheckStatement(), s);
    return measuring::Prover(object, statements, options).run();
}

}  // namespace phasetree
