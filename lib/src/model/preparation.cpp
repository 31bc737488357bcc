#include "model/preparation.hpp"

#include <fmt/format.h>

#include "phasetree/model/handle.hpp"

namespace phasetree::model {

namespace {

// This thread's current budget.
thread_local PreparationTogether* held = nullptr;

}  // namespace

PreparationTogether::PreparationTogether() : around_(held) {
    held = this;
}
PreparationTogether::~PreparationTogether() {
    held = around_;
}

void PreparationTogether::pay(std::string_view node, std::uint64_t steps) {
    if (held == nullptr) return;
    if (steps > most - held->paid_)
        throw ModelError(
            fmt::format("{}: preparing this node and those before it exceeds the limit of {} million steps per scene",
                        node, most / 1'000'000));
    held->paid_ += steps;
}

void Preparation::pay(std::uint64_t steps) {
    if (steps > left())
        throw ModelError(
            fmt::format("{}: preparing this node exceeds the limit of {} million steps; simplify its child, or reduce "
                        "its parameters",
                        node_, most / 1'000'000));
    paid_ += steps;
    PreparationTogether::pay(node_, steps);
}

}  // namespace phasetree::model
