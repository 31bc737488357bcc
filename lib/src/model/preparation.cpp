#include "model/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "phasetree/model/handle.hpp"

namespace phasetree {

namespace {

// This thread's current budget and watch.
thread_local model::PreparationTogether* held = nullptr;
thread_local const PreparationWatch* watching = nullptr;
thread_local const PreparationWatch::Callbacks* watched_by = nullptr;
// Steps that this thread has paid since it last looked at whether its work is cancelled.
thread_local std::uint64_t unpolled = 0;

}  // namespace

PreparationWatch::PreparationWatch(Callbacks callbacks) : callbacks_(std::move(callbacks)), around_(watching) {
    watching = this;
    watched_by = &callbacks_;
}
PreparationWatch::~PreparationWatch() {
    watching = around_;
    watched_by = around_ ? &around_->callbacks_ : nullptr;
}
const PreparationWatch::Callbacks* PreparationWatch::current() {
    return watched_by;
}

namespace model {

PreparationTogether::PreparationTogether() : around_(held) {
    held = this;
}
PreparationTogether::~PreparationTogether() {
    held = around_;
}

void PreparationTogether::pay(std::string_view node, std::uint64_t steps) {
    if (held == nullptr) return;
    // Many small payments, such as those for bounds, take seconds together.
    constexpr std::uint64_t between_polls = 1'000'000;
    if ((unpolled += steps) >= between_polls) {
        unpolled = 0;
        if (watched_by && watched_by->cancelled && watched_by->cancelled()) throw PreparationCancelled();
    }
    const std::uint64_t free = std::min(steps, held->granted_);
    if (steps - free > most - held->paid_)
        throw ModelError(
            fmt::format("{}: preparing this node and those before it exceeds the limit of {} million steps per scene",
                        node, most / 1'000'000));
    held->granted_ -= free;
    held->paid_ += steps - free;
}

void PreparationTogether::grant(const void* content, std::uint64_t steps) {
    if (held != nullptr && held->contents_.insert(content).second) held->granted_ += steps;
}

Preparation::Preparation(std::string_view node, const void* content, std::uint64_t granted)
    : node_(node), watch_(PreparationWatch::current()), granted_(granted) {
    PreparationTogether::grant(content, granted);
}

void Preparation::pay(std::uint64_t steps) {
    poll();
    if (steps > left())
        throw ModelError(
            fmt::format("{}: preparing this node exceeds the limit of {} million steps; simplify its child, or reduce "
                        "its parameters",
                        node_, (granted_ + most) / 1'000'000));
    paid_ += steps;
    PreparationTogether::pay(node_, steps);
}

}  // namespace model

}  // namespace phasetree
