// Creating InterfaceCells: built from an object, or read from a file.
#include <chrono>
#include <utility>

#include "building/divide_within.hpp"
#include "cells/data.hpp"
#include "cells/make_tables.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree {

using building::BuildContext, building::BuildProgress, building::CellsWithinBudget, building::divide_within;
using cells::CellsFile, cells::CellTables, cells::make_tables;
using rewriting::Arena, rewriting::ProgramContext, rewriting::rewrite, rewriting::WorkingProgram;

namespace {

class Stopwatch {
  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

InterfaceCells::InterfaceCells(const Phased& object, const CellOptions& options) {
    const Stopwatch stopwatch;
    auto data = std::make_unique<Data>(object, options);
    Program recorded = phasetree::record(object);
    const std::size_t recorded_constants = recorded.constants.size();
    Arena arena;
    const WorkingProgram rewritten = rewrite(recorded, arena);
    BuildProgress progress(options.progress);
    const BuildContext context{options, progress,
                               ProgramContext(rewritten, recorded.constants, options.opaque, 0.5f * data->resolution),
                               data->reach, data->bounds.diagonal()};
    CellsWithinBudget within = divide_within(data->max_bytes, data->bounds, rewritten, context);
    static_cast<CellTables&>(*data) =
        make_tables(std::move(within.cells), recorded.constants, data->curvature_code, options.cancelled);
    data->recorded_constants = recorded_constants;
    data->is_coarser = within.is_coarser;
    data->whole.emplace(std::move(recorded));
    progress.finish();
    data->build_seconds = stopwatch.seconds();
    data_ = std::move(data);
}

InterfaceCells::InterfaceCells(std::unique_ptr<const Data> data) : data_(std::move(data)) {}

InterfaceCells::~InterfaceCells() = default;

CellsFile::Contents CellsFile::contents(const InterfaceCells& cells) {
    const InterfaceCells::Data& d = *cells.data_;
    return {d, d.whole->program(), d.settings()};
}

cells::BuildSettings CellsFile::settings(const Phased& object, const CellOptions& options) {
    return InterfaceCells::Data(object, options).settings();
}

std::shared_ptr<const InterfaceCells> CellsFile::read(const Phased& object, const CellOptions& options,
                                                      const Reader& reader) {
    const Stopwatch stopwatch;
    auto data = std::make_unique<InterfaceCells::Data>(object, options);
    Program program = phasetree::record(object);
    static_cast<CellTables&>(*data) = reader(program, data->settings());
    data->whole.emplace(std::move(program));
    data->build_seconds = stopwatch.seconds();
    return std::shared_ptr<const InterfaceCells>(new InterfaceCells(std::move(data)));
}

}  // namespace phasetree
