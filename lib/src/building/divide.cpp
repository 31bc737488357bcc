#include "building/divide.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "bounding/enclose.hpp"
#include "building/cost_model.hpp"
#include "building/quality.hpp"
#include "building/workers.hpp"
#include "evaluation/target.hpp"
#include "pruning/jumps.hpp"
#include "rewriting/first_component.hpp"
#include "rewriting/readable_steps.hpp"

namespace phasetree::building {

using bounding::BoxKnowledge, bounding::Encloser, bounding::ValueRanges;
using evaluation::active_kernel, evaluation::ValuesAtPoint;
using pruning::finest_jump, pruning::may_jump, pruning::prune, pruning::RangesInBall, pruning::slopes_in_ball,
    pruning::without_far_bounds;
using rewriting::finest_pattern, rewriting::first_component_first, rewriting::FirstComponentFirst,
    rewriting::has_local_primitive, rewriting::readable_steps, rewriting::ReadableSteps, rewriting::specialised;

namespace {

/// How long it goes on where nothing is won. A share of more than this part of the object is divided all the same, for
/// an object's features are smaller; then so many times more. Programs of little but long primitives (Voronoi cells)
/// are tried less, because a trial costs them as much as many rays. But a neural field costs rays so much, and is known
/// so much better in a small box, that it is divided until its gradient hardly varies.
struct SubdivisionPolicy {
    float large = 0.06f;
    int divisions = 2;
    float uneven = Bounds::infinity;  ///< where a gradient varies by a larger share of it, it goes on, too,
    float fine = 0.004f;              ///< down to this part of the object

    SubdivisionPolicy() = default;
    /// Of a program that is so much work.
    SubdivisionPolicy(const WorkingProgram& program, float all) {
        const auto size = static_cast<float>(program.code.size());
        const auto is_field = [](const Instruction& in) { return traits(in.op).is_network; };
        if (all > 200 + 10 * size && std::ranges::any_of(program.code, is_field)) {
            large = 0.25f;
            divisions = 1;
            uneven = 0.2f;
        } else if (all > 10 * size) {
            large = 0.25f;
        } else if (size > 24) {
            divisions = 5;
        }
    }
};

/// The parts of a box: halves along every axis that is not much shorter than the longest.
struct Parts {
    static constexpr std::size_t most = 8;
    std::array<Bounds, most> box;
    std::size_t count = 1;

    explicit Parts(const Bounds& whole) {
        box[0] = whole;
        const glm::vec3 extent = whole.extent(), middle = whole.centre();
        const float longest = std::max({extent.x, extent.y, extent.z});
        for (int axis = 0; axis < 3; ++axis) {
            if (extent[axis] < 0.6f * longest) continue;
            for (std::size_t i = 0; i < count; ++i) {
                box[count + i] = box[i];
                box[count + i].low[axis] = middle[axis];
                box[i].high[axis] = middle[axis];
            }
            count *= 2;
        }
    }
};

/// A cell that a box could become.
struct Candidate {
    WorkingProgram program;
    Bounds box{};  ///< around its interface
    LinearBound bound{};
    Curvature curvature{};
    std::span<const CertificateStep> certificate{};
    std::span<const LocalValue> local{};
    Work work{};
    float cost = 0;
};

/// A box with its program, and for how many divisions nothing was won. A program that loses an instruction now and then
/// would else be divided to the end, and all for nothing.
struct Share {
    Bounds box;
    WorkingProgram program;
    std::span<const LocalValue> local{};  ///< of this program; until it is ready, of one around
    int depth = 0;
    int stale = 0;
    SubdivisionPolicy policy{};
    float left = 1;                    ///< what is left of the cost since something was won
    float period = Bounds::infinity;   ///< of the finest fold that still jumps
    float pattern = Bounds::infinity;  ///< how large the features of patterns are
    double part = 1;                   ///< of all that is to be done, about
    Candidate cell{};
};

/// Encloses a program in a share's box, and takes from it what cannot matter there; again, while that tells more. Then
/// the box is cut to where the interface is, and if that leaves much less of it, the program is enclosed in what is
/// left. Nothing if no interface passes.
std::optional<Candidate> candidate(const Share& share, const Bounds& all, const WorkingProgram& program,
                                   Encloser& encloser, const BuildContext& d, Worker& w) {
    constexpr int most_rounds = 3;
    Candidate cell{program, all};
    Encloser* enclose = &encloser;
    for (int rounds = 0;; ++rounds) {
        const std::optional<ValueRanges> ranges = enclose->ranges(cell.program);
        if (!ranges) break;
        const auto pruned = prune(cell.program, d.program.constants, *ranges, d.program.opaque, w.programs, w.scratch);
        if (!pruned) return std::nullopt;
        const bool is_all_left =
            pruned->code.size() == cell.program.code.size() && pruned->outputs.size() == cell.program.outputs.size();
        if (!is_all_left && rounds < most_rounds) {
            cell = {*pruned, cell.box};  // whose gradient is better known
            continue;
        }
        const BoxKnowledge enclosed = enclose->rest(cell.program);
        cell.bound = enclosed.bound;
        cell.curvature = enclosed.curvature;
        cell.certificate = w.programs.copy(enclosed.certificate);
        const std::span<LocalValue> local = w.programs.copy(enclosed.local);
        for (LocalValue& v : local) v.data = w.programs.copy(v.data);
        cell.local = local;
        const Bounds around = cell.box;
        cell.box = intersect(around, enclosed.box.inflated(d.reach));
        if (enclosed.box.empty() || cell.box.empty()) return std::nullopt;
        // Lists of local primitives must be those of the whole share, for its parts. What is left of the program is
        // right as far around the box as its parts must be.
        const bool is_narrower = surface(cell.box) < 0.7f * surface(around) &&
                                 !(d.program.has_local_primitives && has_local_primitive(cell.program));
        if (rounds >= most_rounds || !is_narrower) break;
        enclose =
            std::construct_at(w.scratch.take<Encloser>(1).data(), d.program, intersect(all, cell.box.inflated(d.reach)),
                              std::span<const LocalValue>(), w.scratch);
    }
    // Through copies without end a ray goes on and on, and, where nothing is known, from block to block of a pattern.
    const float size = share.box.diagonal();
    const bool has_blocks =
        std::isfinite(share.pattern) && !(cell.bound.spread < 1) && has_local_primitive(cell.program);
    const float blocks = has_blocks ? std::max(1.f, size / share.pattern) : 1.f;
    const float copies = (1 + 4 * size / share.period) * blocks;
    cell.work = work(cell.program, d.program.constants, cell.local, w.scratch);
    cell.cost = copies * cost(cell.box, cell.bound, cell.curvature, cell.program, cell.work, !cell.certificate.empty(),
                              d.program.opaque);
    return cell;
}

/// Makes a share ready. False if no interface passes.
bool prepare(Share& share, const BuildContext& d, Worker& w) {
    const ArenaScope scratch(w.scratch);
    const Bounds all = share.box.inflated(d.reach);
    Encloser encloser(d.program, all, share.local, w.scratch);
    const auto whole = candidate(share, all, share.program, encloser, d, w);
    if (!whole) return false;
    share.program = whole->program;
    share.local = whole->local;
    share.policy = SubdivisionPolicy(share.program, whole->work.all);
    share.cell = *whole;
    share.box = intersect(share.box, whole->box);
    if (share.box.empty()) return false;
    if (!d.program.has_far_bounds) return true;
    // Its parts may want what tells more far away.
    if (const auto near =
            without_far_bounds(share.program, d.program.constants, d.program.opaque, w.programs, w.scratch)) {
        const auto other = candidate(share, all, *near, encloser, d, w);
        if (!other) return false;
        if (other->cost < share.cell.cost) share.cell = *other;
    }
    return true;
}

/// So deep the progress is told: what follows is done soon.
constexpr int told_depth = 5;

/// What cells cost the rays that enter them, and how much interface is in them.
struct Cost {
    float all = 0, interface = 0;
};

Cost divide(const Share& share, const BuildContext& d, Worker& w);

/// Makes a share a cell.
Cost add_cell(const Share& share, Worker& w) {
    const ArenaScope programs(w.programs), scratch(w.scratch);
    const Candidate& cell = share.cell;
    CellBuffer& found = w.found.last();
    const CellBuffer::Mark before = found.mark();
    const WorkingProgram program = specialised(cell.program, cell.local, found.specialised_data, w.scratch);
    FirstComponentFirst led{program};
    if (program.outputs.size() > 2) {
        led = first_component_first(program, w.programs, w.scratch);
        // Behind a neural field what is left to do is next to nothing: then labels are known at once.
        if (cell.work.all < 1.03f * cell.work.first) led.leading = CellBuffer::narrow(program.code.size() - 1);
    }
    const std::span<CertificateStep> certificate = w.scratch.copy(cell.certificate);
    if (!led.renumbered.empty())
        for (CertificateStep& part : certificate) part.value = led.renumbered[part.value];
    found.add(cell.box, cell.bound, cell.curvature, led.program, led.leading, certificate);
    w.account.add(CellBuffer::bytes(before, found.mark()), w.others.budget());
    return {cell.cost, one_interface(cell.box)};
}

/// Finds the cells of a share: itself, or those of its parts where that is cheaper. Its parts tell how much interface
/// is in it, from which rays start as well; of one cell it is taken to be one.
Cost find_cells(const Share& share, const BuildContext& d, Worker& w) {
    const float promise =
        least_gain(d.options.quality, share.box.diagonal() / d.size, share.cell.program.outputs.size() > 2,
                   share.cell.curvature.bound[0] < Curvature::unknown);
    const bool is_hopeless = share.stale >= share.policy.divisions;
    const bool is_small = share.box.diagonal() < 64 * d.reach;
    const float least = least_cost(share.cell.box);
    const bool is_final = is_hopeless || share.depth >= d.options.deepest || is_small ||
                          share.cell.cost < (1 + promise) * least + cost_model::parts * surface(share.box) ||
                          !w.others.budget().is_worth_dividing(share.box, share.cell.cost - least);
    if (is_final) {
        if (share.depth <= told_depth) d.progress.add(share.part);
        return add_cell(share, w);
    }
    const CellBuffers::Mark before = w.found.mark();
    const std::size_t had = w.account.has();
    Cost divided = divide(share, d, w);
    if (share.depth == told_depth) d.progress.add(share.part);
    divided.all += cost_model::parts * surface(share.box);
    const float more = std::max(0.f, divided.interface - one_interface(share.cell.box));
    const float starting = cost_model::starts * more / surface(share.cell.box);
    if (divided.all < share.cell.cost * (1 + starting)) return divided;
    w.found.forget_from(before);
    w.account.keep(had);
    return add_cell(share, w);
}

/// The values of a program's instructions at the centres of parts of a box, one a lane: ValuesAtPoint for each.
ValuesAtPoint values_at_centres(const Share& share, const Parts& parts, const BuildContext& d, Worker& w) {
    Arena& scratch = w.scratch;
    if (w.constants.empty()) w.constants.assign(d.program.constants.begin(), d.program.constants.end());
    const WorkingProgram program = specialised(share.program, share.local, w.constants, scratch);
    const ReadableSteps steps = readable_steps(program, scratch);
    static_assert(batch_size >= Parts::most, "each part has a lane of its own");
    BatchOfFloats x, y, z;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const glm::vec3 c = parts.box[std::min(i, parts.count - 1)].centre();
        x[i] = c.x;
        y[i] = c.y;
        z[i] = c.z;
    }
    const std::span<BatchOfFloats> registers = scratch.take<BatchOfFloats>(steps.slots);
    active_kernel().evaluate(steps.routine(w.constants.data()), x.lane.data(), y.lane.data(), z.lane.data(),
                             registers.data()->lane.data(), nullptr);
    w.constants.resize(d.program.constants.size());
    return {registers.data(), steps.slot, 0};
}

Cost divide(const Share& share, const BuildContext& d, Worker& w) {
    if (d.options.cancelled && d.options.cancelled()) throw BuildCancelled();
    const ArenaScope programs(w.programs), scratch(w.scratch);
    const Parts parts(share.box);
    const ValuesAtPoint values = values_at_centres(share, parts, d, w);
    const bool has_jumps = d.program.has_folds && may_jump(share.program);

    // High up the parts are divided by as many threads, each with memory of its own; the order of the cells is that of
    // the parts, whichever thread finds them.
    const bool in_parallel = share.depth < 3;
    std::vector<Workers::Borrowed> workers;
    for (std::size_t i = 0; in_parallel && i < parts.count; ++i) workers.push_back(w.others.borrow());
    const auto each = [&](auto&& f) {
        if (in_parallel)
            tbb::parallel_for(std::size_t{0}, parts.count, [&](std::size_t i) { f(i, *workers[i]); });
        else
            for (std::size_t i = 0; i < parts.count; ++i) f(i, w);
    };
    const std::span<Share> divided = w.scratch.take<Share>(parts.count);
    std::array<bool, Parts::most> is_left{};
    each([&](std::size_t i, Worker& own) {
        const ArenaScope scope(own.scratch);
        const float radius = 0.5f * parts.box[i].inflated(d.reach).diagonal() * (1 + 1e-5f);
        const ValuesAtPoint centre{values.registers, values.slot, i};
        const std::span<const float> slope = has_jumps ? slopes_in_ball(share.program, d.program.constants, centre,
                                                                        radius, d.program.rounding, own.scratch)
                                                       : share.program.lipschitz;
        const RangesInBall ranges{centre, slope, radius, d.program.rounding};
        const auto program =
            prune(share.program, d.program.constants, ranges, d.program.opaque, own.programs, own.scratch);
        if (!program) return;
        Share& part = *std::construct_at(&divided[i], Share{parts.box[i], *program, share.local, share.depth + 1});
        if (std::isfinite(share.period)) part.period = finest_jump(part.program, d.program.constants);
        if (std::isfinite(share.pattern)) part.pattern = finest_pattern(part.program, d.program.constants);
        is_left[i] = prepare(part, d, own);
    });
    const auto left_count = std::ranges::count(is_left, true);
    if (left_count == 0 && share.depth < told_depth) d.progress.add(share.part);
    float sum = cost_model::parts * surface(share.box);
    for (std::size_t i = 0; i < parts.count; ++i)
        if (is_left[i]) sum += divided[i].cell.cost;
    const float left = share.left * sum / share.cell.cost;
    const bool is_won = left < 0.8f;

    std::array<Cost, Parts::most> costs{};
    each([&](std::size_t i, Worker& own) {
        if (!is_left[i]) return;
        Share& part = divided[i];
        part.part = share.part / static_cast<double>(left_count);
        // An object's features are smaller than a period of a fold, too.
        const float coarse = std::isfinite(part.period) ? 0.25f * part.period : part.policy.large * d.size;
        const float diagonal = part.box.diagonal();
        const LinearBound& bound = part.cell.bound;
        const bool is_uneven =
            bound.slack < Bounds::infinity && bound.spread > part.policy.uneven * glm::length(bound.normal);
        // Of a pattern nothing may be known until boxes are smaller than its features.
        const bool is_unknown = !(bound.spread < 1) && diagonal > 0.5f * part.pattern;
        const bool is_too_coarse =
            diagonal > coarse || is_unknown || (is_uneven && diagonal > part.policy.fine * d.size);
        part.stale = is_won || is_too_coarse ? 0 : share.stale + 1;
        part.left = is_won ? 1.f : left;
        costs[i] = find_cells(part, d, own);
    });
    for (const Workers::Borrowed& worker : workers) {
        w.found.take(worker->found);
        w.account.take(worker->account);
    }
    Cost all;
    for (const Cost& c : costs) {
        all.all += c.all;
        all.interface += c.interface;
    }
    return all;
}

}  // namespace

CellBuffers divide_into_cells(const Bounds& box, const WorkingProgram& program, const BuildContext& d,
                              CellBudget& budget) {
    Share root{box, program};
    root.period = finest_jump(program, d.program.constants);
    root.pattern = finest_pattern(program, d.program.constants);
    Workers workers(budget);
    Worker worker{workers};
    if (!prepare(root, d, worker)) return {};
    if (budget.is_worth_dividing(root.box, root.cell.cost))
        divide(root, d, worker);
    else
        add_cell(root, worker);
    return std::move(worker.found);
}

}  // namespace phasetree::building
