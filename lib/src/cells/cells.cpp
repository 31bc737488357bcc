#include "phasetree/cells/cells.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "building/divide_within.hpp"
#include "cells/curvature_code.hpp"
#include "cells/file.hpp"
#include "evaluation/target.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "rewriting/rewrite.hpp"
#include "trace/march.hpp"
#include "trace/normal.hpp"

namespace phasetree {

using building::BuildContext, building::BuildProgress, building::CellBuffer, building::CellBuffers,
    building::CellsWithinBudget, building::divide_within, building::Routines;
using cells::CellsFile, cells::CellsMade, cells::CellTables, cells::CurvatureCode, cells::InterfaceCell;
using evaluation::active_kernel, evaluation::component;
using kernel::few_slots, kernel::LinearBound, kernel::PackedCertificateStep, kernel::Routine, kernel::Visit;
using rewriting::Arena, rewriting::ProgramContext, rewriting::rewrite, rewriting::WorkingProgram;
using trace::carried_by, trace::NormalOf;

namespace {

std::size_t bytes_for(const CellOptions& options) {
    constexpr std::size_t most = std::size_t{64} << 30;  // so that all can be numbered
    return std::min(options.most_bytes > 0 ? options.most_bytes : default_cell_bytes(), most);
}

}  // namespace

struct InterfaceCells::Data : CellTables {
    using Cell = InterfaceCell;

    /// All but what is built.
    Data(const Phased& object, const CellOptions& options) {
        const TraceableObject traceable = prepare_to_trace(object, options.resolution);
        bounds = traceable.bounds;
        resolution = traceable.resolution;
        warning = traceable.warning;
        reach = 4 * resolution;
        opaque = options.opaque;
        deepest = options.deepest;
        quality = options.quality;
        most_bytes = bytes_for(options);
        curvature_code = CurvatureCode(bounds.diagonal());
    }

    std::optional<Evaluator> whole;
    Bounds bounds;
    float resolution = 0;
    std::string warning;
    float reach = 0;
    PhaseSet opaque;
    int deepest = 0;
    BuildQuality quality{};
    std::size_t most_bytes = 0;
    double build_seconds = 0;

    CurvatureCode curvature_code;

    CellsMade made() const { return {resolution, opaque, deepest, quality, most_bytes}; }

    Routine routine(const Cell& c) const {
        Routine r = routines.routine(routines.shapes[c.shape], c.first_data, whole->program().constants.data());
        r.is_by_own = c.is_by_own;
        r.is_by_first = c.is_by_first;
        return r;
    }
    std::uint32_t slots(const Cell& c) const { return routines.shapes[c.shape].slots; }
    /// Adds a cell's certificate, which is needed where curvature leaves the ray in doubt.
    void certify_sign(Routine& r, std::size_t cell) const {
        r.certificate = certificates.data() + first_certificate[cell];
        r.certificate_steps = first_certificate[cell + 1] - first_certificate[cell];
    }
    /// Whether curvature may leave a ray in doubt that carries this phase.
    bool is_in_doubt(const Cell& c, const Routine& r, const std::optional<Phase>& carried) const {
        const bool is_known = c.curvature != CurvatureCode::unknown,
                   is_other_known = c.other_curvature != CurvatureCode::unknown;
        if (!carried || r.output_count > 2) return !is_known || !is_other_known;
        return !(carried->index == c.first_phase ? is_known : is_other_known);
    }

    std::optional<Crossing> search(std::size_t cell, const TracedRay& ray, float t_min, float t_max,
                                   std::optional<Phase> carried, const std::optional<LeavingHint>& leaving_hint,
                                   Evaluator::Workspace* w, TraceCounters& counters) const {
        ++counters.visits;
        const Cell& c = cells[cell];
        // The next cell that a ray meets is often a neighbour in this list, too.
        __builtin_prefetch(cells.data() + cell + 1);
        __builtin_prefetch(cells.data() + (cell > 0 ? cell - 1 : 0));
        Routine r = routine(c);
        // What is not needed before the ray is clipped is under way until then.
        __builtin_prefetch(r.data);
        __builtin_prefetch(r.data + r.count);
        if (is_in_doubt(c, r, carried)) {
            certify_sign(r, cell);
            __builtin_prefetch(r.certificate);
        }
        const auto many = [&] { return (w ? *w : Evaluator::thread_workspace()).registers(slots(c)); };
        return trace::first_crossing(
            {.box = &c.box,
             .bound = &c.bound,
             .routine = &r,
             .ray = &ray,
             .registers = slots(c) <= few_slots ? nullptr : many(),
             .curvature = {curvature_code.decode(c.curvature), curvature_code.decode(c.other_curvature)},
             .t_min = t_min,
             .t_max = t_max,
             .resolution = resolution,
             .carried = carried_by(carried),
             .rise = leaving_hint ? leaving_hint->rise : Visit::no_leaving_hint},
            counters);
    }

    /// Cells with equal programs share one.
    void add(CellBuffers found, Routines made, const std::function<bool()>& cancelled) {
        cells.reserve(found.cells());
        first_certificate.reserve(found.cells() + 1);
        for (CellBuffer& piece : found) {
            if (cancelled && cancelled()) throw BuildCancelled();
            made.take_specialised_data(piece);
            add(piece, made);
        }
        first_certificate.push_back(CellBuffer::narrow(certificates.size()));
        certificates.shrink_to_fit();
        routine_count = made.count();
        routines = std::move(made.tables);
        routines.shrink_to_fit();
    }
    void add(const CellBuffer& found, Routines& made) {
        for (const CellBuffer::Cell& c : found.cells) {
            const Routines::Ready& r = made.add(found, c);
            // Without its component alone a ray in the first phase knows nothing.
            const bool is_known = c.outputs == 2 || made.tables.shapes[r.shape].leading > 0;
            cells.push_back({c.box, is_known ? c.bound : LinearBound{}, r.shape, r.first_data,
                             curvature_code.encode(c.curvature.bound[0]), curvature_code.encode(c.curvature.bound[1]),
                             found.outputs_of(c)[0].phase.index, c.curvature.is_by_own, c.curvature.is_by_first});
            first_certificate.push_back(CellBuffer::narrow(certificates.size()));
            made.add_certificate(r, found.certificate_of(c), certificates);
        }
    }
};

InterfaceCells::InterfaceCells(const Phased& object, const CellOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    auto data = std::make_unique<Data>(object, options);
    Program recorded = phasetree::record(object);
    data->recorded_constants = recorded.constants.size();
    Arena arena;
    const WorkingProgram rewritten = rewrite(recorded, arena);
    BuildProgress progress(options.progress);
    const BuildContext context{options, progress,
                               ProgramContext(rewritten, recorded.constants, options.opaque, 0.5f * data->resolution),
                               data->reach, data->bounds.diagonal()};
    CellsWithinBudget within = divide_within(data->most_bytes, data->bounds, rewritten, context);
    data->is_coarser = within.is_coarser;
    data->add(std::move(within.found), Routines(recorded.constants), options.cancelled);
    data->whole.emplace(std::move(recorded));
    progress.finish();
    data->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    data_ = std::move(data);
}

InterfaceCells::InterfaceCells(std::unique_ptr<const Data> data) : data_(std::move(data)) {}

CellsFile::Contents CellsFile::contents(const InterfaceCells& cells) {
    const InterfaceCells::Data& d = *cells.data_;
    return {d, d.whole->program(), d.made()};
}

std::shared_ptr<const InterfaceCells> CellsFile::read(const Phased& object, const CellOptions& options,
                                                      const Reader& reader) {
    const auto start = std::chrono::steady_clock::now();
    auto data = std::make_unique<InterfaceCells::Data>(object, options);
    Program program = phasetree::record(object);
    static_cast<CellTables&>(*data) = reader(program, data->made());
    data->whole.emplace(std::move(program));
    data->build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::shared_ptr<const InterfaceCells>(new InterfaceCells(std::move(data)));
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
    return data_->search(cell, TracedRay(origin, direction), t_min, t_max, carried, {}, &w, counters);
}

std::optional<Crossing> InterfaceCells::first_crossing(std::size_t cell, const TracedRay& ray, float t_min, float t_max,
                                                       std::optional<Phase> carried,
                                                       const std::optional<LeavingHint>& leaving_hint,
                                                       TraceCounters& counters) const {
    return data_->search(cell, ray, t_min, t_max, carried, leaving_hint, nullptr, counters);
}

CrossingNormal InterfaceCells::normal(std::size_t cell, const Crossing& c, const glm::vec3& direction) const {
    const Data::Cell& at = data_->cells[cell];
    const auto component_at = [&](const glm::vec3& p, Phase phase) {
        return component(data_->routine(at), data_->slots(at), p, phase);
    };
    const auto holds = [&](const glm::vec3& p) { return at.box.contains(p); };
    return NormalOf(c, direction, data_->resolution, component_at, holds)();
}

void InterfaceCells::sample_ray(std::size_t cell, const glm::vec3& origin, const glm::vec3& direction,
                                const BatchOfFloats& t, Samples& out, Evaluator::Workspace& w) const {
    const Data::Cell& c = data_->cells[cell];
    active_kernel().sample_ray(data_->routine(c), &origin.x, &direction.x, t.lane.data(), w.registers(data_->slots(c)),
                               out.label.lane.data(), out.distance.lane.data());
}

Phase InterfaceCells::label(const glm::vec3& p, Evaluator::Workspace& w) const {
    return data_->bounds.contains(p) ? data_->whole->label(p, w) : vacuum;
}

Phase InterfaceCells::label(std::size_t cell, const glm::vec3& p, Evaluator::Workspace& w) const {
    BatchOfFloats x, y, z;
    x.lane.fill(p.x);
    y.lane.fill(p.y);
    z.lane.fill(p.z);
    Samples s;
    const Data::Cell& c = data_->cells[cell];
    active_kernel().sample(data_->routine(c), x.lane.data(), y.lane.data(), z.lane.data(), w.registers(data_->slots(c)),
                           s.label.lane.data(), s.distance.lane.data());
    return Phase{static_cast<std::uint8_t>(s.label[0])};
}

const Evaluator& InterfaceCells::whole() const {
    return *data_->whole;
}
float InterfaceCells::resolution() const {
    return data_->resolution;
}
const std::string& InterfaceCells::warning() const {
    return data_->warning;
}
float InterfaceCells::reach() const {
    return data_->reach;
}

PhaseSet InterfaceCells::opaque() const {
    return data_->opaque;
}

CellStatistics InterfaceCells::statistics() const {
    CellStatistics s;
    s.cells = data_->cells.size();
    s.routines = data_->routine_count;
    s.bytes = data_->cells.size() * sizeof(Data::Cell) + data_->routines.bytes() +
              data_->certificates.size() * sizeof(PackedCertificateStep) +
              data_->first_certificate.size() * sizeof(data_->first_certificate[0]) + data_->whole->bytes();
    s.build_seconds = data_->build_seconds;
    s.is_coarser = data_->is_coarser;
    if (data_->cells.empty()) return s;
    std::vector<std::size_t> length;
    for (std::size_t i = 0; i < size(); ++i) length.push_back(data_->routines.shapes[data_->cells[i].shape].steps);
    std::sort(length.begin(), length.end());
    s.median_instructions = length[length.size() / 2];
    s.percentile90_instructions = length[length.size() * 9 / 10];
    s.most_instructions = length.back();
    return s;
}

}  // namespace phasetree
