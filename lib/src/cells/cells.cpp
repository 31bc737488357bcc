#include "phasetree/cells/cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>

#include "cells/prune.hpp"
#include "phasetree/trace/tracer.hpp"
#include "program/target.hpp"
#include "trace/march.hpp"
#include "trace/normal.hpp"

namespace phasetree {

namespace {

struct Leaf {
    Bounds box;
    Assembly assembly;
    float cost;
};

/// What a visit to a cell costs beside its instructions, in instructions.
constexpr float visit_cost = 8;

/// What every step of the division needs.
struct Division {
    const CellOptions& options;
    std::span<const float> constants;
    float reach;     ///< how far beyond its share a cell must be right
    float rounding;  ///< error of a value
};

/// The parts of a box: halves along every axis that is not much shorter than the longest.
std::vector<Bounds> parts(const Bounds& box) {
    const glm::vec3 extent = box.extent(), middle = box.centre();
    const float longest = std::max({extent.x, extent.y, extent.z});
    std::vector<Bounds> all{box};
    for (int axis = 0; axis < 3; ++axis) {
        if (extent[axis] < 0.6f * longest) continue;
        const std::size_t n = all.size();
        for (std::size_t i = 0; i < n; ++i) {
            Bounds upper = all[i];
            upper.low[axis] = middle[axis];
            all[i].high[axis] = middle[axis];
            all.push_back(upper);
        }
    }
    return all;
}

/// What rays spend in a cell, up to a factor: how many come (its surface) times what a visit costs.
float cost(const Bounds& box, std::size_t instructions) {
    const glm::vec3 e = box.extent();
    return (e.x * e.y + e.y * e.z + e.z * e.x) * (visit_cost + static_cast<float>(instructions));
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
};

std::vector<Leaf> divide(const Share& share, const Division& d);

/// The cells of a share: itself, or those of its parts where that is cheaper.
std::vector<Leaf> cells_of(const Share& share, const Division& d) {
    const std::size_t instructions = share.program.code.size();
    // Through copies without end a ray goes on and on.
    const float copies = 1 + 4 * share.box.diagonal() / share.period;
    const float whole = cost(share.box, instructions) * copies;
    const bool final = instructions <= d.options.short_program + 1 || share.depth >= d.options.deepest ||
                       share.stale >= d.options.patience || share.box.diagonal() < 64 * d.reach;
    if (!final) {
        std::vector<Leaf> divided = divide(share, d);
        float sum = 0;
        for (const Leaf& leaf : divided) sum += leaf.cost;
        if (sum < whole) return divided;
    }
    std::vector<Leaf> self;
    self.push_back({share.box, assemble(share.program.code, share.program.outputs), whole});
    return self;
}

std::vector<Leaf> divide(const Share& share, const Division& d) {
    if (d.options.cancelled && d.options.cancelled()) throw BuildCancelled();
    const WorkingProgram& program = share.program;
    const std::vector<Bounds> children = parts(share.box);
    std::vector<std::uint32_t> slot;
    const Assembly all = assemble_keeping_all(program.code, program.outputs, slot);
    // The values at the centres of all parts, one a lane.
    BatchOfFloats x{}, y{}, z{};
    for (std::size_t i = 0; i < batch_size; ++i) {
        const glm::vec3 c = children[std::min(i, children.size() - 1)].centre();
        x[i] = c.x;
        y[i] = c.y;
        z[i] = c.z;
    }
    std::vector<BatchOfFloats> registers(all.slots), out(program.outputs.size());
    active_kernel().evaluate(all.routine(d.constants.data()), x.lane.data(), y.lane.data(), z.lane.data(),
                             registers.data()->lane.data(), out.data()->lane.data());

    std::vector<std::optional<WorkingProgram>> pruned(children.size());
    const auto shorten = [&](std::size_t i) {
        std::vector<float> value(program.code.size());
        for (std::size_t k = 0; k < value.size(); ++k) value[k] = registers[slot[k]][i];
        const float radius = 0.5f * children[i].inflated(d.reach).diagonal() * (1 + 1e-5f);
        pruned[i] = prune(program, d.constants, value, radius, d.rounding);
    };
    // The order of the leaves is that of the parts, whichever thread finds them.
    const auto each = [&](auto&& f) {
        if (share.depth < 3)
            tbb::parallel_for(std::size_t{0}, children.size(), f);
        else
            for (std::size_t i = 0; i < children.size(); ++i) f(i);
    };
    each(shorten);
    float sum = 0;
    for (std::size_t i = 0; i < children.size(); ++i)
        if (pruned[i]) sum += cost(children[i], pruned[i]->code.size());
    const float left = share.left * sum / cost(share.box, program.code.size());
    const bool is_won = left < d.options.gain;

    std::vector<std::vector<Leaf>> found(children.size());
    each([&](std::size_t i) {
        if (!pruned[i]) return;
        const float period = std::isfinite(share.period) ? finest_jump(*pruned[i], d.constants) : Bounds::infinity;
        const bool is_too_coarse = children[i].diagonal() > 0.25f * period;
        const int stale = is_won || is_too_coarse ? 0 : share.stale + 1;
        found[i] =
            cells_of({children[i], std::move(*pruned[i]), share.depth + 1, stale, is_won ? 1.f : left, period}, d);
    });
    std::vector<Leaf> leaves;
    for (auto& some : found) std::move(some.begin(), some.end(), std::back_inserter(leaves));
    return leaves;
}

}  // namespace

struct InterfaceCells::Data {
    struct Cell {
        Bounds box;
        std::uint32_t routine;
    };
    struct Record {
        std::uint32_t first_step, steps, first_output, outputs, slots;
    };

    Evaluator whole;
    Bounds bounds;
    float resolution = 0;
    float reach = 0;
    std::vector<Cell> cells;
    std::vector<Record> records;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    double build_seconds = 0;

    explicit Data(Program program) : whole(std::move(program)) {}

    const Record& record(std::size_t cell) const { return records[cells[cell].routine]; }
    Routine routine(std::size_t cell) const {
        const Record& r = record(cell);
        return {steps.data() + r.first_step, r.steps, whole.program().constants.data(), outputs.data() + r.first_output,
                r.outputs};
    }

    /// Cells with equal programs share one.
    void add(const std::vector<Leaf>& leaves) {
        std::unordered_map<std::string, std::uint32_t> known;
        for (const Leaf& leaf : leaves) {
            const auto bytes = [](const auto& v) {
                return std::string_view(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(v[0]));
            };
            std::string key(bytes(leaf.assembly.steps));
            key.append(bytes(leaf.assembly.outputs));
            const auto [where, is_new] = known.emplace(std::move(key), static_cast<std::uint32_t>(records.size()));
            if (is_new) {
                records.push_back({static_cast<std::uint32_t>(steps.size()),
                                   static_cast<std::uint32_t>(leaf.assembly.steps.size()),
                                   static_cast<std::uint32_t>(outputs.size()),
                                   static_cast<std::uint32_t>(leaf.assembly.outputs.size()), leaf.assembly.slots});
                steps.insert(steps.end(), leaf.assembly.steps.begin(), leaf.assembly.steps.end());
                outputs.insert(outputs.end(), leaf.assembly.outputs.begin(), leaf.assembly.outputs.end());
            }
            cells.push_back({leaf.box.inflated(reach), where->second});
        }
    }
};

InterfaceCells::InterfaceCells(const Phased& object, const CellOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const TraceableObject traceable = prepare_to_trace(object, options.resolution);
    auto data = std::make_unique<Data>(phasetree::record(object));
    data->bounds = traceable.bounds;
    data->resolution = traceable.resolution;
    data->reach = 4 * traceable.resolution;

    const Program& program = data->whole.program();
    const Division division{options, program.constants, data->reach, 0.5f * traceable.resolution};
    Share root{data->bounds, {program.instructions, program.lipschitz, outputs_of(program)}};
    root.period = finest_jump(root.program, program.constants);
    data->add(divide(root, division));
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
    ++counters.rays;
    return march_within(data_->cells[cell].box, data_->routine(cell), w.registers(data_->record(cell).slots), origin,
                        direction, t_min, t_max, data_->resolution, carried, counters);
}

glm::vec3 InterfaceCells::normal(std::size_t cell, const Crossing& c, const glm::vec3& direction) const {
    return normal_of(c, direction, [&](const glm::vec3& p, Phase phase) {
        return gradient(data_->routine(cell), data_->record(cell).slots, p, phase);
    });
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
    active_kernel().sample(data_->routine(cell), x.lane.data(), y.lane.data(), z.lane.data(),
                           w.registers(data_->record(cell).slots), s.label.lane.data(), s.distance.lane.data());
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
    s.routines = data_->records.size();
    s.bytes = data_->cells.size() * sizeof(Data::Cell) + data_->records.size() * sizeof(Data::Record) +
              data_->steps.size() * sizeof(Step) + data_->outputs.size() * sizeof(OutputSlot) + data_->whole.bytes();
    s.build_seconds = data_->build_seconds;
    if (data_->cells.empty()) return s;
    std::vector<std::size_t> length;
    for (std::size_t i = 0; i < size(); ++i) length.push_back(data_->record(i).steps);
    std::sort(length.begin(), length.end());
    s.median_instructions = length[length.size() / 2];
    s.percentile90_instructions = length[length.size() * 9 / 10];
    s.most_instructions = length.back();
    return s;
}

}  // namespace phasetree
