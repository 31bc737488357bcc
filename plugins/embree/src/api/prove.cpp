// Statements about trees that are proved or refuted.
#include "phasetree/measuring/prove.hpp"

#include <algorithm>
#include <bit>

#include "api/measured.hpp"
#include "api/tree_data.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::embree::api {

namespace {

static_assert(static_cast<int>(Verdict::proved) == PHASETREE_VERDICT_PROVED);
static_assert(static_cast<int>(Verdict::refuted) == PHASETREE_VERDICT_REFUTED);
static_assert(static_cast<int>(Verdict::undecided) == PHASETREE_VERDICT_UNDECIDED);

ProveOptions converted(const PhasetreeProveOptions* given) {
    PhasetreeProveOptions o;
    phasetreeInitProveOptions(&o);
    if (given) o = *given;
    ProveOptions options;
    options.resolution = o.resolution;
    options.seconds = o.seconds;
    options.max_boxes = o.maxBoxes;
    if (o.cancelled) options.cancelled = [o] { return o.cancelled(o.cancelledUserPtr); };
    if (o.progress) options.progress = [o](float done) { o.progress(o.progressUserPtr, static_cast<double>(done)); };
    return options;
}

// A statement, and its index among all of them, for messages.
class Converter {
  public:
    Converter(const PhasetreeStatement& statement, std::size_t index, std::size_t phase_count)
        : given_(statement), index_(index), phase_count_(phase_count) {}

    Statement run() const {
        require_known(given_.phases);
        Statement s = converted();
        try {
            check_statement(s);
        } catch (const ModelError& e) {
            throw invalid("statement {}: {}", index_, e.what());
        }
        return s;
    }

  private:
    void require_known(PhasetreePhaseSet phases) const {
        if (const int last = 63 - std::countl_zero(phases); last >= static_cast<int>(phase_count_))
            throw invalid("statement {} has phase {}, which does not exist; the tree has {}", index_, last,
                          phase_count_);
    }
    std::vector<Phase> only(int count) const {
        if (std::popcount(given_.phases) != count)
            throw invalid("statement {} has {} phases; its kind needs {}", index_, std::popcount(given_.phases), count);
        return listed();
    }
    std::vector<Phase> listed() const {
        std::vector<Phase> list;
        for_each_phase(given_.phases, [&](int i) { list.push_back(Phase{static_cast<std::uint8_t>(i)}); });
        return list;
    }
    Statement converted() const {
        switch (given_.kind) {
            case PHASETREE_STATEMENT_PRESENT:
                return IsPresent{only(1)[0]};
            case PHASETREE_STATEMENT_CONNECTED:
                return IsConnected{only(1)[0]};
            case PHASETREE_STATEMENT_CLOSED:
                require_known(given_.inside);
                return IsClosed{{given_.phases}, {given_.inside}};
            case PHASETREE_STATEMENT_APART: {
                const std::vector<Phase> two = only(2);
                return AreApart{two[0], two[1], given_.atLeast};
            }
            case PHASETREE_STATEMENT_TOUCHING: {
                const std::vector<Phase> two = only(2);
                return AreTouching{two[0], two[1]};
            }
            case PHASETREE_STATEMENT_WALL:
                return IsThick{only(1)[0], given_.atLeast, given_.reach};
            case PHASETREE_STATEMENT_VOLUME: {
                HasVolume volume{{}, given_.atLeast, given_.atMost};
                for (const Phase p : listed())
                    volume.weights.emplace_back(p, given_.weights ? given_.weights[p.index] : 1.0);
                if (volume.weights.empty()) throw invalid("statement {} has no phases", index_);
                return volume;
            }
            case PHASETREE_STATEMENT_NO_DEAD_NODES:
                return HasNoDeadNodes{};
            case PHASETREE_STATEMENT_TIGHT_BOUNDS:
                return HasTightBounds{given_.atMost};
        }
        throw invalid("statement {} has kind {}, which does not exist", index_, static_cast<int>(given_.kind));
    }

    const PhasetreeStatement& given_;
    std::size_t index_, phase_count_;
};

PhasetreeProof returned(const Proof& proof, std::size_t first_witness) {
    PhasetreeProof to{};
    to.verdict = static_cast<PhasetreeVerdict>(proof.verdict);
    std::copy_n(proof.reason.begin(), std::min<std::size_t>(proof.reason.size(), PHASETREE_REASON_BYTES - 1),
                to.reason);
    to.resolution = proof.resolution;
    to.firstWitness = first_witness;
    to.witnessCount = proof.witnesses.size();
    return to;
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeProveStatements(PhasetreeTree tree, const PhasetreeStatement* statements, size_t count,
                                        const PhasetreeProveOptions* options, PhasetreeProof* proofs,
                                        PhasetreeWitness* witnesses, size_t witness_capacity, size_t* witness_count) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        if (count > 0) require(statements, "statements");
        if (count > 0) require(proofs, "proofs");
        if (witness_capacity > 0) require(witnesses, "witnesses");
        std::vector<Statement> all;
        for (std::size_t i = 0; i < count; ++i)
            all.push_back(Converter(statements[i], i, data.tree.phases.names.size()).run());
        (void)prepare_to_trace(data.tree.object);  // so that other errors are those of options
        const ProveOptions with = converted(options);
        const std::vector<Proof> found = as_argument([&] { return prove(data.tree.object, all, with); });
        std::size_t made = 0;
        for (std::size_t i = 0; i < count; ++i) {
            proofs[i] = returned(found[i], made);
            if (std::holds_alternative<HasVolume>(all[i])) proofs[i].measured = returned(found[i].measured);
            for (const Witness& w : found[i].witnesses) {
                if (made < witness_capacity) witnesses[made] = {{w.point.x, w.point.y, w.point.z}, w.phase.index};
                ++made;
            }
        }
        if (witness_count) *witness_count = made;
    });
}
