#include "building/candidate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bounding/enclose.hpp"
#include "bounding/interface_bounds.hpp"
#include "pruning/prune.hpp"
#include "rewriting/features.hpp"

namespace phasetree::building {

using bounding::Encloser, bounding::interface_bounds, bounding::InterfaceBounds, bounding::ValueRanges;
using pruning::prune, pruning::without_far_bounds;
using rewriting::ArenaScope, rewriting::finest_spacing, rewriting::has_grid, rewriting::has_local_primitive,
    rewriting::work_of_parts;

namespace {

// If cutting a box reduces its surface to less than this fraction, the rest is enclosed again.
constexpr float much_smaller = 0.7f;
// The number of interfaces of a fold's copies that a ray is expected to meet in a box as large as the fold's period: it
// enters and leaves one interface in each of about two copies.
constexpr float copies_in_period = 4;
// The work, in simple instructions, of the few operations that combine the lists of parts of several phases into a
// program's outputs.
constexpr float work_of_joining = 24;
// Lists of parts count as much of a program's work if they are at least this fraction of it, without the operations
// that combine them.
constexpr float least_share_of_work = 0.25f;
// In a box smaller than this many times a part, lists are short enough, because few parts are near it.
constexpr float few_parts = 1.5f;

// Finds the cell that a node could become.
class CandidateSearch {
  public:
    CandidateSearch(const BuildNode& node, const BuildContext& context, Worker& worker)
        : node_(node),
          context_(context),
          worker_(worker),
          size_(node.box.diagonal()),
          region_(node.box.inflated(context.reach)),
          encloser_(context.program, region_, node.specialisations, node.required, worker.scratch) {}

    // The candidate for what is left of a program; nullopt if no ray can meet an interface in the box.
    //
    // Enclosing and pruning alternate as long as pruning deletes something, because the enclosures of what is left are
    // tighter. Then the box is cut to the interfaces. If that shrinks it considerably, everything is repeated in the
    // smaller box.
    std::optional<Candidate> find(const WorkingProgram& program) {
        constexpr int most_rounds = 3;  // Rounds after pruning and after a cut count together.
        Candidate cell{program, {region_}};
        Encloser* encloser = &encloser_;
        for (int round = 0;; ++round) {
            const std::optional<ValueRanges> ranges = encloser->value_ranges(cell.program);
            if (!ranges) break;  // The program is too long to enclose, or folds space.
            const auto pruned = prune(cell.program, *ranges, context_.program, worker_.arenas());
            if (!pruned) return std::nullopt;
            // Treat a program of the same length as the same program. It may have a cheaper operation or a smaller
            // slope, which is not worth another round; the enclosed one is correct, too. After the last round, pruning
            // still decides whether anything is left.
            const bool is_all_left = pruned->code.size() == cell.program.code.size() &&
                                     pruned->outputs.size() == cell.program.outputs.size();
            if (!is_all_left && round < most_rounds) {
                cell = {*pruned, {cell.facts.box}};
                continue;
            }
            const Bounds before = cell.facts.box;
            if (!apply(*encloser, cell)) return std::nullopt;
            if (round >= most_rounds || !is_much_smaller(cell, before)) break;
            encloser = narrower_encloser(cell.facts.box);
        }
        price(cell);
        return cell;
    }

  private:
    // Stores what is known of the interfaces in a cell, and cuts its box to them. Returns false if there are none.
    bool apply(const Encloser& encloser, Candidate& cell) {
        const InterfaceBounds interface = interface_bounds(encloser.enclosed(), worker_.scratch);
        cell.facts.bound = interface.bound;
        cell.facts.curvature = interface.curvature;
        cell.certificate = worker_.programs.copy(interface.certificate);
        cell.facts.has_certificate = !cell.certificate.empty();
        const std::span<Specialisation> specialisations = worker_.programs.copy(encloser.specialisations());
        for (Specialisation& s : specialisations) s.data = worker_.programs.copy(s.data);
        cell.specialisations = specialisations;
        cell.facts.box = intersect(cell.facts.box, interface.box.inflated(context_.reach));
        return !interface.box.empty() && !cell.facts.box.empty();
    }
    // Whether enclosing the program again in the cut box is worthwhile. It is not done with local primitives, because
    // the node's children start from the specialisations in the node's whole box.
    bool is_much_smaller(const Candidate& cell, const Bounds& before) const {
        return surface(cell.facts.box) < much_smaller * surface(before) &&
               !(context_.program.has_local_primitives && has_local_primitive(cell.program));
    }
    // An encloser for a smaller box in the region. It extends beyond the box by the reach, within which programs must
    // be valid.
    Encloser* narrower_encloser(const Bounds& box) {
        return std::construct_at(worker_.scratch.allocate<Encloser>(1).data(), context_.program,
                                 intersect(region_, box.inflated(context_.reach)), std::span<const Specialisation>(),
                                 std::span<const RequiredOfLocal>(), worker_.scratch);
    }
    void price(Candidate& cell) const {
        // A ray passes many of the copies of a fold, and many blocks of a pattern about which nothing is known in the
        // box. So the cost is multiplied by the expected numbers of copies and blocks. Components have slopes of at
        // most 1, so a linear bound with a spread of 1 says nothing about them.
        const bool has_blocks = std::isfinite(node_.pattern_period) && !(cell.facts.bound.spread < 1) &&
                                (has_local_primitive(cell.program) || has_grid(cell.program));
        const float blocks = has_blocks ? std::max(1.f, size_ / node_.pattern_period) : 1.f;
        const float repetitions = (1 + copies_in_period * size_ / node_.fold_period) * blocks;
        cell.work = work(cell.program, context_.program.constants, cell.specialisations, worker_.scratch);
        cell.cost = repetitions * cost(cell.facts, cell.program, cell.work, context_.program.opaque);
        if (!context_.program.has_local_primitives) return;
        const bool is_searched = has_search(cell);
        const float of_parts = work_of_parts(cell.program, cell.specialisations);
        if (!is_searched && of_parts >= least_share_of_work * (cell.work.all - work_of_joining))
            cell.work_of_parts = of_parts;
        // Lists in small boxes are short, unless the interface is far from the parts, as with a thick wall around a
        // mesh; then there would be a great many smaller boxes.
        cell.is_searched = is_searched && size_ > few_parts * finest_spacing(cell.program, context_.program.constants);
    }

    // Whether a primitive of many parts lacks a list of the parts that matter.
    bool has_search(const Candidate& cell) const {
        const std::span<const Instruction> code = cell.program.code;
        for (std::uint32_t i = 1; i < code.size(); ++i)  // instruction 0 is the point
            if (program::traits(code[i].op).has_many_parts &&
                std::ranges::find(cell.specialisations, i, &Specialisation::value) == cell.specialisations.end())
                return true;
        return false;
    }

    const BuildNode& node_;
    const BuildContext& context_;
    Worker& worker_;
    float size_;     // of the node's box, which is cut once the first candidate is found
    Bounds region_;  // the node's box, inflated by the reach of its cells
    Encloser encloser_;
};

// Turns a node's cell into one of faces, if its program is a single mesh of which few faces touch the box. Returns
// false if none does.
bool use_faces(BuildNode& node, const BuildContext& context, Worker& worker) {
    if (!context.program.has_local_primitives) return true;
    const auto mesh = lone_mesh(node.program, context.program.constants);
    if (!mesh) return true;
    Candidate& cell = node.cell;
    const auto found = faces_in_box(*mesh, cell.facts.box, worker.programs);
    if (!found) return true;
    if (found->faces.empty()) return false;
    cell.facts.box = intersect(cell.facts.box, found->box.inflated(context.reach));
    cell.faces = found->faces;
    cell.specialisations = {};
    cell.is_searched = false;
    cell.work_of_parts = 0;
    cell.cost = cost_of_faces(cell.facts.box, cell.faces.size());
    return true;
}

}  // namespace

bool prepare(BuildNode& node, const BuildContext& context, Worker& worker) {
    const ArenaScope scratch(worker.scratch);
    CandidateSearch search(node, context, worker);
    const auto whole = search.find(node.program);
    if (!whole) return false;
    node.program = whole->program;
    node.specialisations = whole->specialisations;
    node.policy = SubdivisionPolicy(node.program, whole->work.all);
    node.cell = *whole;
    if (!use_faces(node, context, worker)) return false;
    node.box = intersect(node.box, node.cell.facts.box);
    if (node.box.empty()) return false;
    if (!context.program.has_far_bounds || !node.cell.faces.empty()) return true;
    // A cell may be cheaper without far bounds. The node keeps them, because its children may need them.
    if (const auto near = without_far_bounds(node.program, context.program, worker.arenas())) {
        const auto other = search.find(*near);
        if (!other) return false;  // It has the same signs, and provably no interface in the box.
        if (other->cost < node.cell.cost) node.cell = *other;
    }
    return true;
}

}  // namespace phasetree::building
