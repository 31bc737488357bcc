#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_map>

#include "phasetree/program/program.hpp"
#include "tree/node.hpp"
#include "program/op_traits.hpp"

namespace phasetree {

using program::operands;

namespace {

class Recorder;

/// The number type that records: a value is the index of the instruction that computes it.
struct Recorded {
    Recorder* recorder = nullptr;
    std::uint32_t id = 0;
};

/// A recorded point.
struct RecordedPoint {
    std::uint32_t id = 0;
};

class Recorder {
  public:
    using Scalar = Recorded;
    using Point = RecordedPoint;

    Recorder(Program& program, std::size_t limit) : program_(program), limit_(limit) {
        program_.instructions.push_back({});
        program_.lipschitz.push_back(1.f);
    }

    // Defined behind the operations of Recorded, which the nodes' equations use.
    Recorded field(const Field&, const RecordedPoint&);
    Phases<Recorded> phases(const Phased&, const RecordedPoint&);

    template <class P>
    Recorded primitive(const P& primitive, const RecordedPoint& p) {
        if constexpr (DataPrimitive<P>) {
            const auto index = Primitives::size + index_in<P>(DataPrimitives());
            return emit(derived(index), p.id, 0, primitive.data(), lipschitz(p.id));
        } else {
            return emit(derived(index_in<P>(Primitives())), p.id, 0, floats(primitive), lipschitz(p.id));
        }
    }

    template <class M>
    RecordedPoint map(const M& m, const RecordedPoint& p, float stretch) {
        const auto index = Primitives::size + DataPrimitives::size + index_in<M>(PointMaps());
        return {emit(derived(index), p.id, 0, floats(m), lipschitz(p.id) * stretch).id};
    }

    /// Hash-consing: an instruction that is already there is not written again.
    Recorded emit(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> data, float lipschitz) {
        work(1 + data.size() / 16);
        std::uint64_t hash = mix(mix(static_cast<std::uint64_t>(op), a), b);
        for (const float f : data) hash = mix(hash, std::bit_cast<std::uint32_t>(f));
        for (;; ++hash) {
            const auto next = static_cast<std::uint32_t>(program_.instructions.size());
            const auto [where, is_new] = known_.emplace(hash, next);
            if (is_new) {
                if (next >= limit_)
                    throw ModelError(
                        fmt::format("the object takes more than {} instructions: shared shapes multiply it", limit_));
                if (program_.constants.size() + data.size() > most_constants)
                    throw ModelError(
                        fmt::format("the object's instructions carry more than {} numbers: shared shapes "
                                    "multiply those of an image, a network or an outline",
                                    most_constants));
                program_.instructions.push_back({op, a, b, static_cast<std::uint32_t>(program_.constants.size())});
                program_.constants.insert(program_.constants.end(), data.begin(), data.end());
                program_.lipschitz.push_back(lipschitz);
                return {this, next};
            }
            if (is_same(where->second, op, a, b, data)) return {this, where->second};
        }
    }

    Recorded one_lipschitz(Recorded value, const RecordedPoint& p) {
        program_.lipschitz[value.id] = std::min(lipschitz(value), lipschitz(p.id));
        return value;
    }

    float lipschitz(std::uint32_t id) const { return program_.lipschitz[id]; }
    float lipschitz(Recorded a) const { return lipschitz(a.id); }
    float largest(Recorded a, Recorded b) const { return std::max(lipschitz(a), lipschitz(b)); }
    bool is(Recorded a, Op op) const { return program_.instructions[a.id].op == op; }
    Recorded operand(Recorded a) { return {this, program_.instructions[a.id].a}; }

  private:
    struct Key {
        const void* node;
        std::uint32_t point;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const { return std::hash<const void*>()(k.node) * 31 + k.point; }
    };

    /// Copies that come to the same write nothing, and are work all the same.
    void work(std::size_t steps) {
        work_ += steps;
        if (work_ > most_work_for_one * limit_)
            throw ModelError(
                fmt::format("to find the object's instructions takes more than {} steps: shared shapes multiply them",
                            most_work_for_one * limit_));
    }

    /// The opcode of what is derived from the list of nodes.
    static Op derived(std::size_t index) {
        return static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + index);
    }
    static std::uint64_t mix(std::uint64_t h, std::uint64_t v) {
        h = (h ^ v) * 0x9e3779b97f4a7c15u;
        return h ^ (h >> 29);
    }
    bool is_same(std::uint32_t i, Op op, std::uint32_t a, std::uint32_t b, std::span<const float> data) const {
        const Instruction& in = program_.instructions[i];
        const std::size_t end =
            i + 1 < program_.instructions.size() ? program_.instructions[i + 1].data : program_.constants.size();
        return in.op == op && in.a == a && in.b == b && end - in.data == data.size() &&
               (data.empty() || std::memcmp(program_.constants.data() + in.data, data.data(), data.size_bytes()) == 0);
    }

    template <class Struct>
    static std::span<const float> floats(const Struct& s) {
        static_assert(sizeof(Struct) % sizeof(float) == 0 && alignof(Struct) == alignof(float),
                      "what an instruction carries must be floats");
        return {reinterpret_cast<const float*>(&s), sizeof(Struct) / sizeof(float)};
    }

    static constexpr std::size_t most_work_for_one = 16, most_constants = std::size_t{1} << 28;

    Program& program_;
    std::size_t limit_, work_ = 0;
    std::unordered_map<std::uint64_t, std::uint32_t> known_;  ///< by hash, or the next free number after it
    std::unordered_map<Key, Recorded, Hash> fields_;
    std::unordered_map<Key, std::vector<std::pair<int, std::uint32_t>>, Hash> objects_;
};

[[maybe_unused]] Recorded operator-(Recorded a) {
    if (a.recorder->is(a, Op::negate)) return a.recorder->operand(a);
    return a.recorder->emit(Op::negate, a.id, 0, {}, a.recorder->lipschitz(a));
}
[[maybe_unused]] Recorded operator+(Recorded a, Recorded b) {
    return a.recorder->emit(Op::add, a.id, b.id, {}, a.recorder->lipschitz(a) + a.recorder->lipschitz(b));
}
[[maybe_unused]] Recorded operator-(Recorded a, Recorded b) {
    return a.recorder->emit(Op::subtract, a.id, b.id, {}, a.recorder->lipschitz(a) + a.recorder->lipschitz(b));
}
[[maybe_unused]] Recorded operator+(Recorded a, float b) {
    return a.recorder->emit(Op::add_constant, a.id, 0, {&b, 1}, a.recorder->lipschitz(a));
}
[[maybe_unused]] Recorded operator-(Recorded a, float b) {
    return a + -b;
}
[[maybe_unused]] Recorded operator-(float a, Recorded b) {
    return b.recorder->emit(Op::constant_minus, b.id, 0, {&a, 1}, b.recorder->lipschitz(b));
}
[[maybe_unused]] Recorded operator*(Recorded a, float b) {
    return a.recorder->emit(Op::multiply_constant, a.id, 0, {&b, 1}, a.recorder->lipschitz(a) * std::abs(b));
}
Recorded min(Recorded a, Recorded b) {
    return a.id == b.id ? a : a.recorder->emit(Op::minimum, a.id, b.id, {}, a.recorder->largest(a, b));
}
Recorded max(Recorded a, Recorded b) {
    return a.id == b.id ? a : a.recorder->emit(Op::maximum, a.id, b.id, {}, a.recorder->largest(a, b));
}
[[maybe_unused]] Recorded far_bound(Recorded f, Recorded bound) {
    return f.recorder->emit(Op::far_bound, f.id, bound.id, {}, f.recorder->largest(f, bound));
}
[[maybe_unused]] Recorded far_bound_inside(Recorded f, Recorded bound) {
    return f.recorder->emit(Op::far_bound_inside, f.id, bound.id, {}, f.recorder->largest(f, bound));
}
Recorded abs(Recorded a) {
    return a.recorder->emit(Op::absolute, a.id, 0, {}, a.recorder->lipschitz(a));
}
Recorded smooth_min(Recorded a, Recorded b, float r) {
    return a.recorder->emit(Op::smooth_minimum, a.id, b.id, {&r, 1}, a.recorder->largest(a, b));
}
[[maybe_unused]] Recorded guarded(Recorded bound, Recorded f, float far) {
    return bound.recorder->emit(Op::guarded, bound.id, f.id, {&far, 1}, bound.recorder->lipschitz(bound));
}
[[maybe_unused]] Recorded falloff(Recorded d, float reach) {
    return d.recorder->emit(Op::falloff, d.id, 0, {&reach, 1}, d.recorder->lipschitz(d) * (steepest_falloff / reach));
}
/// No steeper than the steeper one, because a and b vary along orthogonal directions.
[[maybe_unused]] Recorded corner(Recorded a, Recorded b) {
    return a.recorder->emit(Op::corner, a.id, b.id, {}, a.recorder->largest(a, b));
}
Recorded smooth_max(Recorded a, Recorded b, float r) {
    return -smooth_min(-a, -b, r);
}

Recorded Recorder::field(const Field& f, const RecordedPoint& p) {
    work(1);
    const Key key{f.node(), p.id};
    if (const auto found = fields_.find(key); found != fields_.end()) return found->second;
    const Recorded r = std::visit(
        [&](const auto& n) {
            using N = std::remove_cvref_t<decltype(n)>;
            if constexpr (Primitive<N> || DataPrimitive<N>)
                return primitive(n, p);
            else
                return n.evaluate(*this, p);
        },
        f.node()->node);
    fields_.emplace(key, r);
    return r;
}

Phases<Recorded> Recorder::phases(const Phased& a, const RecordedPoint& p) {
    work(1);
    const Key key{a.node(), p.id};
    if (const auto found = objects_.find(key); found != objects_.end()) {
        Phases<Recorded> r;
        for (const auto& [phase, id] : found->second) r.set(phase, {this, id});
        return r;
    }
    auto r = std::visit([&](const auto& n) { return n.evaluate(*this, p); }, a.node()->node);
    auto& compact = objects_[key];
    for_each_phase(r.present, [&](int i) { compact.emplace_back(i, r[i].id); });
    return r;
}

/// Deletes what no output needs: operators compute components that a node above may not use.
void remove_dead(Program& program) {
    std::vector<char> live(program.instructions.size(), 0);
    live[0] = 1;
    for (const Output& o : program.outputs) live[o.value] = 1;
    for (std::size_t i = live.size(); i-- > 1;) {
        if (!live[i]) continue;
        const Instruction& in = program.instructions[i];
        if (operands(in.op) > 0) live[in.a] = 1;
        if (operands(in.op) > 1) live[in.b] = 1;
    }
    std::vector<std::uint32_t> moved(live.size(), 0);
    Program kept;
    for (std::size_t i = 0; i < live.size(); ++i) {
        if (!live[i]) continue;
        moved[i] = static_cast<std::uint32_t>(kept.instructions.size());
        Instruction in = program.instructions[i];
        const std::size_t end = i + 1 < live.size() ? program.instructions[i + 1].data : program.constants.size();
        const auto from = program.constants.begin() + in.data,
                   to = program.constants.begin() + static_cast<std::ptrdiff_t>(end);
        in.data = static_cast<std::uint32_t>(kept.constants.size());
        if (i > 0) kept.constants.insert(kept.constants.end(), from, to);
        in.a = moved[in.a];
        in.b = moved[in.b];
        kept.instructions.push_back(in);
        kept.lipschitz.push_back(program.lipschitz[i]);
    }
    for (const Output& o : program.outputs) kept.outputs.push_back({o.phase, moved[o.value]});
    program = std::move(kept);
}

}  // namespace

std::size_t Program::bytes() const {
    return instructions.size() * sizeof(Instruction) + constants.size() * sizeof(float) +
           outputs.size() * sizeof(Output) + lipschitz.size() * sizeof(float);
}

Program record(const Phased& object, std::size_t limit) {
    Program program;
    Recorder recorder(program, limit);
    const Phases<Recorded> phases = recorder.phases(object, {});
    for_each_phase(phases.present, [&](int i) {
        program.outputs.push_back({Phase{static_cast<std::uint8_t>(i)}, phases[i].id});
    });
    remove_dead(program);
    return program;
}

Program record(const Field& field, std::size_t limit) {
    return record(Phased(Set{.phase = Phase{1}, .of = field}), limit);
}

}  // namespace phasetree
