// Recording: a tree is evaluated once, with numbers that write instructions.
#include <unordered_map>

#include "phasetree/program/program.hpp"
#include "program/dead_code.hpp"
#include "program/record_pair.hpp"
#include "program/recorded.hpp"
#include "tree/domain.hpp"
#include "tree/node.hpp"

namespace phasetree {

using program::InstructionList, program::Recorded, program::RecordedPoint;

namespace {

// The domain in which nodes are evaluated to record them (EvaluationDomain).
class Recorder {
  public:
    using Scalar = Recorded;
    using Point = RecordedPoint;

    Recorder(Program& program, std::size_t limit) : list_(program, limit) {}

    // A node is not evaluated again at a point where it was recorded before, so that shared subtrees cost little.
    Recorded field(const Field& f, const RecordedPoint& p) {
        list_.work(1);
        const Key key{f.node(), p.value};
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

    Phases<Recorded> phases(const Phased& a, const RecordedPoint& p) {
        list_.work(1);
        const Key key{a.node(), p.value};
        if (const auto found = objects_.find(key); found != objects_.end()) {
            Phases<Recorded> r;
            for (const auto& [phase, value] : found->second) r.set(phase, {&list_, value});
            return r;
        }
        auto r = std::visit([&](const auto& n) { return n.evaluate(*this, p); }, a.node()->node);
        auto& compact = objects_[key];
        for_each_phase(r.present, [&](int i) { compact.emplace_back(i, r[i].value); });
        return r;
    }

    template <class P>
    Recorded primitive(const P& primitive, const RecordedPoint& p) {
        if constexpr (DataPrimitive<P>)
            return {&list_, emit(Primitives::size + index_in<P>(DataPrimitives()), p, primitive.data(), 1)};
        else
            return {&list_, emit(index_in<P>(Primitives()), p, floats(primitive), 1)};
    }

    template <class M>
    RecordedPoint map(const M& m, const RecordedPoint& p, float lipschitz) {
        return {emit(Primitives::size + DataPrimitives::size + index_in<M>(PointMaps()), p, floats(m), lipschitz)};
    }

    Recorded one_lipschitz(Recorded f, const RecordedPoint& p) {
        list_.limit_lipschitz(f.value, list_.lipschitz(p.value));
        return f;
    }

  private:
    struct Key {
        const void* node;
        std::uint32_t point;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const { return std::hash<const void*>()(k.node) * 31 + k.point; }
    };

    // Emits a primitive or a map of space, whose operations follow Op::first_primitive.
    std::uint32_t emit(std::size_t index, const RecordedPoint& p, std::span<const float> constants, float lipschitz) {
        const auto op = static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + index);
        return list_.emit(op, p.value, 0, constants, list_.lipschitz(p.value) * lipschitz);
    }
    // The parameters of a primitive or a map, as the constants of its instruction.
    template <class Struct>
    static std::span<const float> floats(const Struct& s) {
        static_assert(sizeof(Struct) % sizeof(float) == 0 && alignof(Struct) == alignof(float),
                      "what an instruction carries must be floats");
        return {reinterpret_cast<const float*>(&s), sizeof(Struct) / sizeof(float)};
    }

    InstructionList list_;
    std::unordered_map<Key, Recorded, Hash> fields_;
    std::unordered_map<Key, std::vector<std::pair<int, std::uint32_t>>, Hash> objects_;
};
static_assert(EvaluationDomain<Recorder>);

void add_outputs(Program& program, Recorder& recorder, const Phased& object) {
    const Phases<Recorded> phases = recorder.phases(object, {});
    for_each_phase(phases.present, [&](int i) {
        program.outputs.push_back({Phase{static_cast<std::uint8_t>(i)}, phases[i].value});
    });
}

}  // namespace

std::size_t Program::bytes() const {
    return instructions.size() * sizeof(Instruction) + constants.size() * sizeof(float) +
           outputs.size() * sizeof(Output) + lipschitz.size() * sizeof(float);
}

Program record(const Phased& object, std::size_t limit) {
    Program program;
    Recorder recorder(program, limit);
    add_outputs(program, recorder, object);
    return program::without_dead_code(std::move(program));
}

program::RecordedPair program::record_pair(const Phased& first, const Phased& second, std::size_t limit) {
    RecordedPair pair;
    Recorder recorder(pair.program, limit);
    add_outputs(pair.program, recorder, first);
    pair.outputs_of_first = pair.program.outputs.size();
    add_outputs(pair.program, recorder, second);
    pair.program = without_dead_code(std::move(pair.program));
    return pair;
}

Program record(const Field& field, std::size_t limit) {
    return record(Phased(Set{.phase = Phase{1}, .of = field}), limit);
}

}  // namespace phasetree
