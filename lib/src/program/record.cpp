#include <fmt/format.h>

#include <cstring>
#include <map>
#include <unordered_map>

#include "phasetree/nodes/node.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree {

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

    Recorded field(const Field& f, const RecordedPoint& p) {
        const Key key{f.node(), p.id};
        if (const auto found = fields_.find(key); found != fields_.end()) return found->second;
        const Recorded r = std::visit(
            [&](const auto& n) {
                if constexpr (Primitive<std::remove_cvref_t<decltype(n)>>)
                    return primitive(n, p);
                else
                    return n.evaluate(*this, p);
            },
            f.node()->node);
        fields_.emplace(key, r);
        return r;
    }

    Phases<Recorded> phases(const Phased& a, const RecordedPoint& p) {
        const Key key{a.node(), p.id};
        if (const auto found = objects_.find(key); found != objects_.end()) return found->second;
        auto r = std::visit([&](const auto& n) { return n.evaluate(*this, p); }, a.node()->node);
        objects_.emplace(key, r);
        return r;
    }

    template <class P>
    Recorded primitive(const P& primitive, const RecordedPoint& p) {
        const auto op = static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + index_in<P>(Primitives()));
        return emit(op, p.id, 0, floats(primitive), lipschitz(p.id));
    }

    template <class M>
    RecordedPoint map(const M& m, const RecordedPoint& p, float stretch) {
        const auto op = static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + Primitives::size +
                                        index_in<M>(PointMaps()));
        return {emit(op, p.id, 0, floats(m), lipschitz(p.id) * stretch).id};
    }

    Recorded emit(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> data, float lipschitz) {
        std::string key(reinterpret_cast<const char*>(&op), sizeof op);
        key.append(reinterpret_cast<const char*>(&a), sizeof a).append(reinterpret_cast<const char*>(&b), sizeof b);
        key.append(reinterpret_cast<const char*>(data.data()), data.size_bytes());
        const auto next = static_cast<std::uint32_t>(program_.instructions.size());
        const auto [where, is_new] = known_.emplace(std::move(key), next);
        if (is_new) {
            if (next >= limit_)
                throw ModelError(
                    fmt::format("the object takes more than {} instructions: shared shapes multiply it", limit_));
            program_.instructions.push_back({op, a, b, static_cast<std::uint32_t>(program_.constants.size())});
            program_.constants.insert(program_.constants.end(), data.begin(), data.end());
            program_.lipschitz.push_back(lipschitz);
        }
        return {this, where->second};
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

    template <class Struct>
    static std::span<const float> floats(const Struct& s) {
        static_assert(sizeof(Struct) % sizeof(float) == 0 && alignof(Struct) == alignof(float),
                      "what an instruction carries must be floats");
        return {reinterpret_cast<const float*>(&s), sizeof(Struct) / sizeof(float)};
    }

    Program& program_;
    std::size_t limit_;
    std::unordered_map<std::string, std::uint32_t> known_;
    std::unordered_map<Key, Recorded, Hash> fields_;
    std::unordered_map<Key, Phases<Recorded>, Hash> objects_;
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
Recorded abs(Recorded a) {
    return a.recorder->emit(Op::absolute, a.id, 0, {}, a.recorder->lipschitz(a));
}
Recorded smooth_min(Recorded a, Recorded b, float r) {
    return a.recorder->emit(Op::smooth_minimum, a.id, b.id, {&r, 1}, a.recorder->largest(a, b));
}
Recorded smooth_max(Recorded a, Recorded b, float r) {
    return -smooth_min(-a, -b, r);
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
    return program;
}

Program record(const Field& field, std::size_t limit) {
    return record(Phased(Set{.phase = Phase{1}, .of = field}), limit);
}

}  // namespace phasetree
