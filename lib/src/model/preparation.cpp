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
            fmt::format("{}: this and the nodes before it take more work to prepare than a scene may: "
                        "{} million steps",
                        node, most / 1'000'000));
    held->paid_ += steps;
}

void Preparation::pay(std::uint64_t steps) {
    if (steps > left())
        throw ModelError(
            fmt::format("{}: it takes more work to prepare than a node may, {} million steps: give it "
                        "something simpler, or ask for less of it",
                        node_, most / 1'000'000));
    paid_ += steps;
    PreparationTogether::pay(node_, steps);
}

}  // namespace phasetree::model
