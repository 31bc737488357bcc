#include "phasetree/cells/cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "cells/enclose.hpp"
#include "cells/outward.hpp"
#include "cells/prune.hpp"
#include "cells/steps.hpp"
#include "phasetree/trace/tracer.hpp"
#include "program/target.hpp"
#include "trace/march.hpp"
#include "trace/normal.hpp"

namespace phasetree {

namespace {

/// Cells found so far, in order, with the routines that they need.
struct Found {
    struct Cell {
        Bounds box;
        LinearBound bound;
        std::uint32_t first_step, steps, first_output, outputs, slots;
    };
    std::vector<Cell> cells;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;

    struct Mark {
        std::size_t cells, steps, outputs;
    };
    Mark mark() const { return {cells.size(), steps.size(), outputs.size()}; }
    void forget_from(const Mark& m) {
        cells.resize(m.cells);
        steps.resize(m.steps);
        outputs.resize(m.outputs);
    }
    void add(const Bounds& box, const LinearBound& bound, const WorkingProgram& program) {
        const Mark m = mark();
        const std::uint32_t slots = assemble(program.code, program.outputs, steps, outputs);
        cells.push_back({box, bound, narrow(m.steps), narrow(steps.size() - m.steps), narrow(m.outputs),
                         narrow(outputs.size() - m.outputs), slots});
    }
    void add(const Found& more) {
        const Mark m = mark();
        for (Cell c : more.cells) {
            c.first_step += narrow(m.steps);
            c.first_output += narrow(m.outputs);
            cells.push_back(c);
        }
        steps.insert(steps.end(), more.steps.begin(), more.steps.end());
        outputs.insert(outputs.end(), more.outputs.begin(), more.outputs.end());
    }
    static std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }
};

/// What a thread works with.
struct Worker {
    Arena programs, scratch;
    Found found;
};

/// A share of more than this part of the object is divided even if nothing was won by that for long.
constexpr float large = 0.06f;

/// What every step of the division needs.
struct Division {
    const CellOptions& options;
    std::span<const float> constants;
    float reach;     ///< how far beyond its share a cell must be right
    float rounding;  ///< error of a value
    float size;      ///< of the object
};

/// The parts of a box: halves along every axis that is not much shorter than the longest.
struct Parts {
    std::array<Bounds, 8> box;
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

/// What rays spend in a cell, in nanoseconds for each unit of surface (which is how many come, up to a factor). Rough:
/// only what is dearer than what matters.
namespace price {
constexpr float parts = 12;               ///< of Embree's going down to the parts of a box
constexpr float visit = 45;               ///< of entering a cell
constexpr float batch = 25, step = 4.5f;  ///< of a batch, and of each of its instructions
constexpr float certain = 1.5f;           ///< batches where the field is linear,
constexpr float unknown = 0.5f;           ///< more of them the less it lets rays pass without one,
constexpr float uneven = 1;               ///< and the more its gradient varies
}  // namespace price

/// How much work a program is, in simple instructions.
float work(const WorkingProgram& program) {
    constexpr auto first = static_cast<std::uint32_t>(Op::first_primitive);
    float sum = 0;
    for (const Instruction& in : program.code.subspan(1)) {
        const auto op = static_cast<std::uint32_t>(in.op);
        sum += op < first ? 1.f : is_long_primitive(in.op) ? 60.f : 1.5f;
    }
    return sum;
}

float surface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

float cost(const Bounds& box, const LinearBound& bound, float steps) {
    float unknown = 3, spread = 1;
    if (bound.slack < Bounds::infinity) {
        const float thickness = 0.5f * glm::dot(glm::abs(bound.normal), box.extent());
        unknown = std::min(1.f, bound.slack / std::max(thickness, 1e-30f));
        spread = std::min(1.f, bound.spread);
    }
    const float batches = price::certain + price::unknown * unknown + price::uneven * spread;
    return surface(box) * (price::visit + batches * (price::batch + price::step * steps));
}
/// A cell of this size cannot cost less.
float least_cost(const Bounds& box) {
    return surface(box) * (price::visit + price::certain * (price::batch + price::step));
}

/// A box with its program, and for how many divisions nothing was won. A program that loses an instruction now and then
/// would else be divided to the end, and all for nothing.
struct Share {
    Bounds box;
    WorkingProgram program;
    int depth = 0;
    int stale = 0;
    float left = 1;                   ///< what is left of the cost since something was won
    float period = Bounds::infinity;  ///< of the finest fold that still jumps
    // If it becomes a cell:
    Bounds cell{};  ///< around its interface
    LinearBound bound{};
    float cost = 0;
};

/// Makes a share ready: encloses its program, and takes from it what cannot matter. False if no interface passes.
bool prepare(Share& share, const Division& d, Worker& w) {
    const Bounds all = share.box.inflated(d.reach);
    share.cell = all;
    for (int i = 0; i < 2; ++i) {
        const ArenaScope scratch(w.scratch);
        const std::optional<Enclosed> enclosed = enclose(share.program, d.constants, all, d.rounding, w.scratch);
        if (!enclosed) break;
        if (enclosed->is_free) return false;
        share.bound = enclosed->bound;
        share.cell = intersect(all, enclosed->box.inflated(d.reach));
        if (share.cell.empty()) return false;
        if (i > 0) break;
        const auto pruned = prune(share.program, d.constants, enclosed->ranges, w.programs, w.scratch);
        if (!pruned) return false;
        if (pruned->code.size() == share.program.code.size() && pruned->outputs.size() == share.program.outputs.size())
            break;
        share.program = *pruned;  // whose gradient is better known
    }
    // Through copies without end a ray goes on and on.
    const float copies = 1 + 4 * share.box.diagonal() / share.period;
    share.cost = cost(share.cell, share.bound, work(share.program)) * copies;
    return true;
}

float divide(const Share& share, const Division& d, Worker& w);

/// Finds the cells of a share: itself, or those of its parts where that is cheaper. Returns what they cost.
float find_cells(const Share& share, const Division& d, Worker& w) {
    // Small cells must promise more, for they are many.
    const float size = share.box.diagonal() / d.size;
    const float promise = d.options.least_gain * (1 + 0.1f / size);
    const bool is_hopeless = share.stale >= (share.program.code.size() > 24 ? 5 : 2);
    const bool is_final = is_hopeless || share.depth >= d.options.deepest || share.box.diagonal() < 64 * d.reach ||
                          share.cost < (1 + promise) * least_cost(share.cell) + price::parts * surface(share.box);
    if (!is_final) {
        const Found::Mark before = w.found.mark();
        const float divided = divide(share, d, w) + price::parts * surface(share.box);
        if (divided < share.cost) return divided;
        w.found.forget_from(before);
    }
    w.found.add(share.cell, share.bound, share.program);
    return share.cost;
}

/// The values of a program's instructions at the centres of parts of a box, one a lane: ValuesAt for each.
ValuesAt values_at_centres(const WorkingProgram& program, const Parts& parts, const Division& d, Arena& scratch) {
    const Steps steps = keep_all(program, scratch);
    BatchOfFloats x, y, z;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const glm::vec3 c = parts.box[std::min(i, parts.count - 1)].centre();
        x[i] = c.x;
        y[i] = c.y;
        z[i] = c.z;
    }
    const std::span<BatchOfFloats> registers = scratch.take<BatchOfFloats>(steps.slots);
    active_kernel().evaluate(steps.routine(d.constants.data()), x.lane.data(), y.lane.data(), z.lane.data(),
                             registers.data()->lane.data(), nullptr);
    return {registers.data(), steps.slot, 0};
}

float divide(const Share& share, const Division& d, Worker& w) {
    if (d.options.cancelled && d.options.cancelled()) throw BuildCancelled();
    const ArenaScope programs(w.programs), scratch(w.scratch);
    const Parts parts(share.box);
    const ValuesAt values = values_at_centres(share.program, parts, d, w.scratch);

    // High up the parts are divided by as many threads, each with memory of its own; the order of the cells is that of
    // the parts, whichever thread finds them.
    const bool in_parallel = share.depth < 3;
    std::vector<Worker> workers(in_parallel ? parts.count : 0);
    const auto each = [&](auto&& f) {
        if (in_parallel)
            tbb::parallel_for(std::size_t{0}, parts.count, [&](std::size_t i) { f(i, workers[i]); });
        else
            for (std::size_t i = 0; i < parts.count; ++i) f(i, w);
    };
    std::array<std::optional<Share>, 8> divided;
    each([&](std::size_t i, Worker& own) {
        const ArenaScope scope(own.scratch);
        const float radius = 0.5f * parts.box[i].inflated(d.reach).diagonal() * (1 + 1e-5f);
        const ValueRanges ranges = ranges_in_ball(share.program, d.constants, {values.registers, values.slot, i},
                                                  radius, d.rounding, own.scratch);
        const auto program = prune(share.program, d.constants, ranges, own.programs, own.scratch);
        if (!program) return;
        Share part{parts.box[i], *program, share.depth + 1};
        if (std::isfinite(share.period)) part.period = finest_jump(part.program, d.constants);
        if (prepare(part, d, own)) divided[i] = part;
    });
    float sum = price::parts * surface(share.box);
    for (const std::optional<Share>& part : divided)
        if (part) sum += part->cost;
    const float left = share.left * sum / share.cost;
    const bool is_won = left < 0.8f;

    std::array<float, 8> costs{};
    each([&](std::size_t i, Worker& own) {
        if (!divided[i]) return;
        Share& part = *divided[i];
        // An object's features are smaller than a large part of it, and than a period of a fold.
        const bool is_too_coarse =
            part.box.diagonal() > (std::isfinite(part.period) ? 0.25f * part.period : large * d.size);
        part.stale = is_won || is_too_coarse ? 0 : share.stale + 1;
        part.left = is_won ? 1.f : left;
        costs[i] = find_cells(part, d, own);
    });
    for (const Worker& worker : workers) w.found.add(worker.found);
    float all = 0;
    for (const float c : costs) all += c;
    return all;
}

}  // namespace

struct InterfaceCells::Data {
    /// One line of the cache.
    struct alignas(64) Cell {
        Bounds box;
        LinearBound bound;
        std::uint32_t first_step, steps, first_output, slots : 24, outputs : 8;
    };
    static_assert(sizeof(Cell) == 64);

    Evaluator whole;
    Bounds bounds;
    float resolution = 0;
    float reach = 0;
    std::vector<Cell> cells;
    std::size_t routines = 0;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    double build_seconds = 0;

    explicit Data(Program program) : whole(std::move(program)) {}

    Routine routine(const Cell& c) const {
        return {steps.data() + c.first_step, c.steps, whole.program().constants.data(), outputs.data() + c.first_output,
                c.outputs};
    }

    /// Cells with equal programs share one.
    void add(const Found& found) {
        cells.reserve(found.cells.size());
        const auto bytes = [](const auto& v, std::uint32_t first, std::uint32_t count) {
            return std::string_view(reinterpret_cast<const char*>(v.data() + first), count * sizeof(v[0]));
        };
        const auto key = [&](const Found::Cell& c) {
            return std::pair(bytes(found.steps, c.first_step, c.steps),
                             bytes(found.outputs, c.first_output, c.outputs));
        };
        const auto hash = [](const std::pair<std::string_view, std::string_view>& k) {
            const std::hash<std::string_view> of;
            return of(k.first) ^ (of(k.second) * 0x9e3779b97f4a7c15u);
        };
        std::unordered_map<std::pair<std::string_view, std::string_view>, const Cell*, decltype(hash)> known(
            found.cells.size() / 4 + 16, hash);
        for (const Found::Cell& c : found.cells) {
            cells.push_back(
                {c.box, c.bound, Found::narrow(steps.size()), c.steps, Found::narrow(outputs.size()), 0, 0});
            Cell& cell = cells.back();
            cell.slots = c.slots & 0xffffffu;
            cell.outputs = c.outputs & 0xffu;
            const auto [where, is_new] = known.emplace(key(c), &cell);
            if (is_new) {
                const auto first = found.steps.begin() + c.first_step;
                steps.insert(steps.end(), first, first + c.steps);
                const auto end = found.outputs.begin() + c.first_output;
                outputs.insert(outputs.end(), end, end + c.outputs);
            } else {
                cell.first_step = where->second->first_step;
                cell.first_output = where->second->first_output;
            }
        }
        routines = known.size();
        steps.shrink_to_fit();
        outputs.shrink_to_fit();
    }
};

InterfaceCells::InterfaceCells(const Phased& object, const CellOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const TraceableObject traceable = prepare_to_trace(object, options.resolution);
    Program recorded = phasetree::record(object);
    const OutwardProgram outward = move_negations_outward(recorded);
    auto data = std::make_unique<Data>(std::move(recorded));
    data->bounds = traceable.bounds;
    data->resolution = traceable.resolution;
    data->reach = 4 * traceable.resolution;

    const Program& program = data->whole.program();
    const Division division{options, program.constants, data->reach, 0.5f * traceable.resolution,
                            data->bounds.diagonal()};
    Share root{data->bounds, {outward.code, outward.lipschitz, outward.outputs}};
    root.period = finest_jump(root.program, program.constants);
    Worker worker;
    if (prepare(root, division, worker)) divide(root, division, worker);
    data->add(worker.found);
    data->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    data_ = std::move(data);
}

InterfaceCells::~InterfaceCells() = default;

std::size_t InterfaceCells::size() const {
    return data_->cells.size();
}
Bounds InterfaceCells::bounds(std::size_t cell) const {
    return data_->cells[cell].box;
}
const Bounds& InterfaceCells::bounds() const {
    return data_->bounds;
}

std::optional<Crossing> InterfaceCells::first_crossing(std::size_t cell, const glm::vec3& origin,
                                                       const glm::vec3& direction, float t_min, float t_max,
                                                       std::optional<Phase> carried, Evaluator::Workspace& w,
                                                       TraceCounters& counters) const {
    return first_crossing(cell, TracedRay(origin, direction), t_min, t_max, carried, false, w, counters);
}

std::optional<Crossing> InterfaceCells::first_crossing(std::size_t cell, const TracedRay& ray, float t_min, float t_max,
                                                       std::optional<Phase> carried, bool is_certified,
                                                       Evaluator::Workspace& w, TraceCounters& counters) const {
    ++counters.rays;
    const Data::Cell& c = data_->cells[cell];
    const Routine routine = data_->routine(c);
    // What is not needed before the ray is clipped is under way until then.
    __builtin_prefetch(routine.steps);
    __builtin_prefetch(routine.outputs);
    return march_within(c.box, c.bound, routine, c.slots, ray, t_min, t_max, data_->resolution, carried, is_certified,
                        w, counters);
}

glm::vec3 InterfaceCells::normal(std::size_t cell, const Crossing& c, const glm::vec3& direction) const {
    const Data::Cell& at = data_->cells[cell];
    return normal_of(c, direction,
                     [&](const glm::vec3& p, Phase phase) { return gradient(data_->routine(at), at.slots, p, phase); });
}

Phase InterfaceCells::label(const glm::vec3& p, Evaluator::Workspace& w) const {
    return data_->bounds.contains(p) ? data_->whole.label(p, w) : vacuum;
}

Phase InterfaceCells::label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace& w) const {
    BatchOfFloats x, y, z;
    x.lane.fill(p.x);
    y.lane.fill(p.y);
    z.lane.fill(p.z);
    Samples s;
    const Data::Cell& c = data_->cells[cell];
    active_kernel().sample(data_->routine(c), x.lane.data(), y.lane.data(), z.lane.data(), w.registers(c.slots),
                           s.label.lane.data(), s.distance.lane.data());
    return Phase{static_cast<std::uint8_t>(s.label[0])};
}

const Evaluator& InterfaceCells::whole() const {
    return data_->whole;
}
float InterfaceCells::resolution() const {
    return data_->resolution;
}
float InterfaceCells::reach() const {
    return data_->reach;
}

CellStatistics InterfaceCells::statistics() const {
    CellStatistics s;
    s.cells = data_->cells.size();
    s.routines = data_->routines;
    s.bytes = data_->cells.size() * sizeof(Data::Cell) + data_->steps.size() * sizeof(Step) +
              data_->outputs.size() * sizeof(OutputSlot) + data_->whole.bytes();
    s.build_seconds = data_->build_seconds;
    if (data_->cells.empty()) return s;
    std::vector<std::size_t> length;
    for (std::size_t i = 0; i < size(); ++i) length.push_back(data_->cells[i].steps);
    std::sort(length.begin(), length.end());
    s.median_instructions = length[length.size() / 2];
    s.percentile90_instructions = length[length.size() * 9 / 10];
    s.most_instructions = length.back();
    return s;
}

}  // namespace phasetree
