#include "program/instruction_list.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cstring>

#include "phasetree/model/handle.hpp"
#include "phasetree/model/poll_preparation.hpp"
#include "phasetree_support/mixed_hash.hpp"

namespace phasetree::program {

namespace {

// In a long list of constants, such as an image, only this many, evenly spaced, are hashed. Lists with equal hashes are
// compared in full.
constexpr std::size_t most_hashed = 512;

std::uint64_t hash_of(std::span<const float> constants) {
    std::uint64_t hash = support::mixed(0, constants.size());
    const std::size_t step = std::max<std::size_t>(1, constants.size() / most_hashed);
    for (std::size_t i = 0; i < constants.size(); i += step)
        hash = support::mixed(hash, std::bit_cast<std::uint32_t>(constants[i]));
    return hash;
}

}  // namespace

InstructionList::InstructionList(Program& program, std::size_t limit) : program_(program), limit_(limit) {
    program_.instructions.push_back({});
    program_.lipschitz.push_back(1.f);
}

std::uint32_t InstructionList::emit(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> constants,
                                    float lipschitz) {
    work(1 + constants.size() / 16);
    std::uint64_t hash = support::mixed(support::mixed(static_cast<std::uint64_t>(op), a), b);
    hash = support::mixed(hash, hash_of(constants));
    for (;; ++hash) {
        const auto next = static_cast<std::uint32_t>(program_.instructions.size());
        const auto [where, is_new] = known_.emplace(hash, next);
        if (!is_new) {
            if (is_same(where->second, op, a, b, constants)) return where->second;
            continue;
        }
        if (next >= limit_)
            throw ModelError(
                fmt::format("the object needs more than {} instructions, because every use of a shape repeats it; use "
                            "fewer copies in the tree, or place copies of the whole object with \"instances\" of the "
                            "scene",
                            limit_));
        if (program_.constants.size() + constants.size() > most_constants)
            throw ModelError(
                fmt::format("the object's instructions hold more than {} numbers, because every use of a shape repeats "
                            "its image, network or outline; use fewer copies of it",
                            most_constants));
        program_.instructions.push_back({op, a, b, static_cast<std::uint32_t>(program_.constants.size())});
        program_.constants.insert(program_.constants.end(), constants.begin(), constants.end());
        program_.lipschitz.push_back(lipschitz);
        return next;
    }
}

void InstructionList::work(std::size_t steps) {
    // Recording the largest programs takes seconds.
    constexpr std::size_t between_polls = std::size_t{1} << 16;
    if ((work_ + steps) / between_polls != work_ / between_polls) poll_preparation();
    work_ += steps;
    if (work_ > most_work_for_one * limit_)
        throw ModelError(fmt::format(
            "finding the object's instructions takes more than {} steps, because every use of a shape repeats it; "
            "use fewer copies in the tree, or place copies of the whole object with \"instances\" of the scene",
            most_work_for_one * limit_));
}

void InstructionList::limit_lipschitz(std::uint32_t value, float bound) {
    program_.lipschitz[value] = std::min(program_.lipschitz[value], bound);
}

bool InstructionList::is_same(std::uint32_t value, Op op, std::uint32_t a, std::uint32_t b,
                              std::span<const float> constants) const {
    const Instruction& in = program_.instructions[value];
    const std::size_t end =
        value + 1 < program_.instructions.size() ? program_.instructions[value + 1].data : program_.constants.size();
    return in.op == op && in.a == a && in.b == b && end - in.data == constants.size() &&
           (constants.empty() ||
            std::memcmp(program_.constants.data() + in.data, constants.data(), constants.size_bytes()) == 0);
}

}  // namespace phasetree::program
