// The recursive subdivision. Decisions are made bottom-up, as when building a bounding volume hierarchy by the surface
// area heuristic: a box becomes one cell unless the cells of its children cost less (cost_model.hpp). How deep to go
// depends on a bound on the possible saving.
#include "building/divide.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "building/children.hpp"
#include "building/quality.hpp"
#include "building/trial.hpp"
#include "pruning/jumps.hpp"
#include "rewriting/features.hpp"
#include "rewriting/first_component.hpp"

namespace phasetree::building {

using pruning::finest_jump;
using rewriting::ArenaScope, rewriting::finest_pattern, rewriting::first_component_first,
    rewriting::FirstComponentFirst, rewriting::specialised;

namespace {

// Progress is reported down to this depth; what lies deeper takes little time. Each share is reported exactly once. At
// this depth, that is when a box is done. Above it, that is when a box becomes a cell without a trial, or when no ray
// can meet an interface in any of its children.
constexpr int reported_depth = 5;
// Down to this depth, the children of a box are divided in parallel.
constexpr int parallel_depth = 3;

// A division counts as a gain if it reduces the cost below this fraction.
constexpr float gain = 0.8f;

// A box in which millions of parts are searched may be divided this often beyond CellOptions::max_depth, because each
// search costs rays far more than the division. This does not apply if fewer divisions than usual are requested, as for
// a preview, which has few rays.
constexpr int more_divisions_of_searches = 3;
int more_divisions(const Candidate& cell, const CellOptions& options) {
    return cell.is_searched && options.max_depth >= CellOptions().max_depth ? more_divisions_of_searches : 0;
}

// The total cost of cells, and the approximate area of the interfaces in them.
struct CellCosts {
    float all = 0, interface_area = 0;
};

CellCosts divide(const BuildNode&, const BuildContext&, Worker&);

// Turns a node into one cell.
CellCosts add_cell(const BuildNode& node, Worker& worker) {
    const ArenaScope programs(worker.programs), scratch(worker.scratch);
    const Candidate& cell = node.cell;
    CellBuffer& cells = worker.cells.last();
    const CellBuffer::Mark before = cells.mark();
    const WorkingProgram program =
        specialised(cell.program, cell.specialisations, cells.specialised_data, worker.scratch);
    FirstComponentFirst ordered{program};
    if (program.outputs.size() > 2) {
        ordered = first_component_first(program, worker.arenas());
        // If the first component takes nearly all of the work, as in a neural field, rays evaluate the whole program at
        // once and so know their labels.
        if (cell.work.all < 1.03f * cell.work.first) ordered.prefix = narrow(program.code.size() - 1);
    }
    const std::span<CertificateStep> certificate = worker.scratch.copy(cell.certificate);
    if (!ordered.renumbered.empty())
        for (CertificateStep& step : certificate) step.value = ordered.renumbered[step.value];
    CellBuffer::Cell found{cell.facts.box, cell.facts.bound, cell.facts.curvature};
    found.first_component_steps = ordered.prefix;
    cells.add(found, ordered.program, certificate, cell.faces);
    worker.account.add(CellBuffer::bytes(before, cells.mark()), worker.pool.budget());
    return {cell.cost, interface_area(cell.facts.box)};
}

// Whether dividing a node may pay off for rays.
bool may_pay_off(const BuildNode& node, const BuildContext& context) {
    const Candidate& cell = node.cell;
    const float diagonal = node.box.diagonal();
    // More faces than this are expensive to intersect. With fewer, Embree's traversal costs more than is saved.
    constexpr std::size_t few_faces = 24;
    if (!cell.faces.empty())
        return cell.faces.size() > few_faces && node.depth < context.options.max_depth &&
               !(diagonal < 64 * context.reach);
    const float saving = required_saving(
        context.options.quality,
        {diagonal / context.size, cell.program.outputs.size() > 2, cell.facts.curvature.bound[0] < Curvature::unknown});
    // Lists of millions of parts would be divided until memory is exhausted. Rays gain little from lists shorter than
    // this, and there are eight times as many of them (benchmarks/experiments.md).
    constexpr float short_list = 192;
    constexpr int divided_in_any_case = 3;  // levels
    const bool has_few_parts =
        cell.work_of_parts > 0 && cell.work_of_parts <= short_list && node.depth >= divided_in_any_case;
    const int max_depth = context.options.max_depth + more_divisions(cell, context.options);
    const bool is_small = diagonal < 64 * context.reach;
    const float least = (1 + saving) * least_cost(cell.facts.box) + cost_model::traversal * surface(node.box);
    return node.futile_divisions < node.policy.most_futile_divisions && node.depth < max_depth && !is_small &&
           !has_few_parts && !(cell.cost < least);
}

// The most that rays could save if a node is divided.
float largest_saving(const BuildNode& node) {
    if (!node.cell.faces.empty()) return node.cell.cost - cost_of_faces(node.cell.facts.box, 1);
    return node.cell.cost - least_cost(node.cell.facts.box);
}

// Finds the cells of a node: either the node itself, or the cells of its children if they cost less.
CellCosts find_cells(const BuildNode& node, const BuildContext& context, Worker& worker) {
    const bool is_divided =
        may_pay_off(node, context) && worker.pool.budget().request_division(node.box, largest_saving(node));
    if (!is_divided) {
        if (node.depth <= reported_depth) context.progress.add(node.share);
        return add_cell(node, worker);
    }
    const CellBuffers::Mark before = worker.cells.mark();
    const std::size_t bytes_before = worker.account.bytes();
    CellCosts divided = divide(node, context, worker);
    if (node.depth == reported_depth) context.progress.add(node.share);
    divided.all += cost_model::traversal * surface(node.box);
    // Rays also start at interfaces. A single cell is assumed to have one interface across it. If the children have
    // found more, more rays start in it than its cost accounts for.
    const Bounds& box = node.cell.facts.box;
    const float excess_area = std::max(0.f, divided.interface_area - interface_area(box));
    const float starting = cost_model::starting_rays * excess_area / surface(box);
    // The cost assumes that a ray passes one or two interfaces in a cell. In a cell with many balls or mesh pieces it
    // passes many, or stops at the first. Then, cells with few parts are always better.
    if (node.cell.is_searched || divided.all < node.cell.cost * (1 + starting)) return divided;
    worker.cells.discard_from(before);
    worker.account.reset_to(bytes_before);
    return add_cell(node, worker);
}

// The division of one node: its children, and the workers that find their cells.
class Division {
  public:
    Division(const BuildNode& node, const BuildContext& context, Worker& worker)
        : node_(node), context_(context), worker_(worker), children_(node, context, worker) {
        if (node.depth < parallel_depth)
            for (std::size_t i = 0; i < children_.count(); ++i) borrowed_.push_back(worker.pool.borrow());
    }

    CellCosts run() {
        for_each_child([&](std::size_t i, Worker& own) { children_.prepare(i, own); });
        left_count_ = children_.left_count();
        // If a child is left, the shares of the children are reported instead, where their cells are found.
        if (left_count_ == 0 && node_.depth < reported_depth) context_.progress.add(node_.share);
        cost_ratio_ = node_.cost_ratio * children_.cost() / node_.cell.cost;

        std::array<CellCosts, SubBoxes::most> costs{};
        for_each_child([&](std::size_t i, Worker& own) {
            if (children_.is_left(i)) costs[i] = find_cells_of_child(children_[i], own);
        });
        for (const WorkerPool::Borrowed& own : borrowed_) {
            worker_.cells.append(own->cells);
            worker_.account.merge(own->account);
        }
        CellCosts sum;
        for (const CellCosts& c : costs) {
            sum.all += c.all;
            sum.interface_area += c.interface_area;
        }
        return sum;
    }

  private:
    // Calls f with each child's index and the worker that finds its cells. In parallel, each child has its own worker,
    // so the cells are in the order of the children, whichever thread finds them.
    template <class F>
    void for_each_child(F&& f) {
        if (!borrowed_.empty())
            tbb::parallel_for(std::size_t{0}, children_.count(), [&](std::size_t i) { f(i, *borrowed_[i]); });
        else
            for (std::size_t i = 0; i < children_.count(); ++i) f(i, worker_);
    }

    CellCosts find_cells_of_child(BuildNode& child, Worker& own) const {
        const bool is_gain = cost_ratio_ < gain;
        child.share = node_.share / static_cast<double>(left_count_);
        child.futile_divisions = 0;
        if (!is_gain && !is_too_coarse(child)) {
            if (needs_trial(child)) child.is_small_cheaper = may_gain_by_known_pattern(child, context_, own);
            if (!may_show_pattern(child)) child.futile_divisions = node_.futile_divisions + 1;
        }
        child.cost_ratio = is_gain ? 1.f : cost_ratio_;
        return find_cells(child, context_, own);
    }
    // Whether a box is so large that its division need not save anything yet.
    bool is_too_coarse(const BuildNode& child) const {
        // Endless copies repeat an object whose features are smaller than the period of the fold. So boxes are compared
        // with that period instead of the size of the whole.
        const float large =
            std::isfinite(child.fold_period) ? 0.25f * child.fold_period : child.policy.large * context_.size;
        const float diagonal = child.box.diagonal();
        const LinearBound& bound = child.cell.facts.bound;
        const bool is_uneven =
            bound.slack < Bounds::infinity && bound.spread > child.policy.uneven * glm::length(bound.normal);
        return child.cell.is_searched || diagonal > large ||
               (is_uneven && diagonal > child.policy.fine * context_.size);
    }
    // Whether nothing is known about a pattern until boxes are smaller than its features, and dividing down to that
    // size is worthwhile, as far as a trial has shown.
    static bool may_show_pattern(const BuildNode& child) {
        return is_pattern_unknown(child) && child.is_small_cheaper.value_or(true);
    }
    // Whether showing a pattern may take many divisions, so that a trial must decide. There is one trial for a box and
    // everything in it.
    static bool needs_trial(const BuildNode& child) {
        constexpr float far = 32;  // times the size of boxes in which the pattern is known
        return !child.is_small_cheaper && is_pattern_unknown(child) &&
               child.box.diagonal() > far * known_share_of_period * child.pattern_period;
    }

    const BuildNode& node_;
    const BuildContext& context_;
    Worker& worker_;
    Children children_;
    std::ptrdiff_t left_count_ = 0;
    float cost_ratio_ = 1;                        // BuildNode::cost_ratio after this division
    std::vector<WorkerPool::Borrowed> borrowed_;  // one per child; none if they are not divided in parallel
};

// Finds the cells of the children of a node.
CellCosts divide(const BuildNode& node, const BuildContext& context, Worker& worker) {
    if (context.options.cancelled && context.options.cancelled()) throw BuildCancelled();
    const ArenaScope programs(worker.programs), scratch(worker.scratch);
    return Division(node, context, worker).run();
}

}  // namespace

CellBuffers divide_into_cells(const Bounds& box, const WorkingProgram& program, const BuildContext& context,
                              CellBudget& budget) {
    BuildNode root{box, program};
    root.fold_period = finest_jump(program, context.program.constants);
    root.pattern_period = finest_pattern(program, context.program.constants);
    WorkerPool pool(budget, context.program.constants);
    Worker worker{pool};
    if (!prepare(root, context, worker)) return {};
    // The root is divided whenever the budget allows, without a comparison with a single cell, because boxes that are
    // large relative to the object always are (SubdivisionPolicy). Its saving is taken to be its whole cost. A budget
    // for a single cell (divide_within.cpp) rejects that, and so finds where savings begin.
    if (budget.request_division(root.box, root.cell.cost))
        divide(root, context, worker);
    else
        add_cell(root, worker);
    return std::move(worker.cells);
}

}  // namespace phasetree::building
