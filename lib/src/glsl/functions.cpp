#include "glsl/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "program/dispatch.hpp"
#include "program/fused.hpp"
#include "program/op_traits.hpp"

namespace phasetree::glsl {

using program::first_map, program::gives_point, program::operands;

namespace {

template <class T>
std::string name_of_type(const char* otherwise) {
    if constexpr (requires { T::info.name; })
        return std::string(T::info.name);
    else
        return otherwise;
}

// A map of space is named after its warp.
template <class W>
void add_warp_name(std::size_t map, std::string& name) {
    if (index_in<typename W::Map>(PointMaps()) == map) name = std::string(W::info.name);
}
template <class... Ws>
std::string name_of_map(TypeList<Ws...>, std::size_t map) {
    std::string name = "map";
    (add_warp_name<Ws>(map, name), ...);
    return name;
}

std::string name_of(Op op) {
    const auto number = static_cast<std::uint32_t>(op);
    constexpr auto first = static_cast<std::uint32_t>(Op::first_primitive);
    std::string name = "primitive";
    if (number < first) return "combine";
    if (number >= first_map) return name_of_map(Warps(), number - first_map);
    if (number < first + Primitives::size)
        program::dispatch(Primitives(), number - first, [&]<class P>() { name = name_of_type<P>("primitive"); });
    else
        program::dispatch(DataPrimitives(), number - first - static_cast<std::uint32_t>(Primitives::size),
                          [&]<class P>() { name = name_of_type<P>("primitive"); });
    return name;
}

std::vector<std::uint32_t> bits_of(std::span<const float> numbers) {
    std::vector<std::uint32_t> result;
    for (const float v : numbers) result.push_back(std::bit_cast<std::uint32_t>(v));
    return result;
}

// Replaces the names of parameters by arguments.
std::string with_arguments(const std::string& text, std::span<const std::string> arguments) {
    const auto is_word = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '_' || c == '.';
    };
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_alone = (i == 0 || !is_word(text[i - 1])) && (i + 1 == text.size() || !is_word(text[i + 1]));
        if (is_alone && text[i] >= 'x' && static_cast<std::size_t>(text[i] - 'x') < arguments.size())
            result += arguments[static_cast<std::size_t>(text[i] - 'x')];
        else
            result += text[i];
    }
    return result;
}

// The beginning of a function that consists of a single return statement.
const std::string returned = "    return ";
bool is_expression(const std::string& text) {
    return text.size() < 60 && text.starts_with(returned) && text.find('\n') == text.size() - 1;
}

}  // namespace

std::uint32_t Functions::add(Op op, std::span<const float> constants) {
    auto key = std::pair(op, bits_of(constants));
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const Trace trace = trace_of(op, constants);
    FunctionText text = text_of(trace);
    Instance instance;
    instance.slots = text.slots;
    if (text.has_lookup) instance.data.assign(constants.begin(), constants.end());
    const auto [shape, is_new] =
        shapes_.try_emplace({op, text.float_body + text.dual_body}, static_cast<std::uint32_t>(functions_.size()));
    if (is_new) {
        std::string name = "pt_" + name_of(op);
        if (const std::uint32_t others = names_[name]++; others > 0) name += fmt::format("_{}", others + 1);
        functions_.push_back({op, std::move(name), std::move(text), false, {}, {}});
    }
    instance.function = shape->second;
    instances_.push_back(std::move(instance));
    const auto number = static_cast<std::uint32_t>(instances_.size() - 1);
    known_.emplace(std::move(key), number);
    return number;
}

void Functions::finish() {
    for (std::uint32_t f = 0; f < functions_.size(); ++f) assign_offsets(f);
}

// Decides which numbers of a function become literals in its text, and assigns offsets to the others.
void Functions::assign_offsets(std::uint32_t number) {
    Function& function = functions_[number];
    std::vector<Instance*> instances;
    for (Instance& i : instances_)
        if (i.function == number) instances.push_back(&i);
    const auto bits = [](const NumberSlot& s) { return bits_of(s.numbers); };
    const auto same_everywhere = [&](std::size_t a, std::size_t b) {
        return std::ranges::all_of(instances,
                                   [&](const Instance* i) { return bits(i->slots[a]) == bits(i->slots[b]); });
    };
    std::vector<std::vector<float>> blocks(instances.size());
    function.slot_texts.resize(function.text.slots.size());
    std::vector<std::size_t> written;
    for (std::size_t s = 0; s < function.slot_texts.size(); ++s) {
        const NumberSlot& slot = function.text.slots[s];
        const auto equal = std::ranges::find_if(written, [&](std::size_t p) {
            return function.text.slots[p].is_table == slot.is_table && same_everywhere(p, s);
        });
        if (equal != written.end()) {
            function.slot_texts[s] = function.slot_texts[*equal];
            continue;
        }
        const bool is_known = std::ranges::all_of(
            instances, [&](const Instance* i) { return bits(i->slots[s]) == bits(instances.front()->slots[s]); });
        if (is_known && !slot.is_table) {
            function.slot_texts[s] = literal(instances.front()->slots[s].numbers[0]);
            continue;
        }
        const std::size_t offset = blocks[0].size();
        for (std::size_t i = 0; i < instances.size(); ++i)
            blocks[i].insert(blocks[i].end(), instances[i]->slots[s].numbers.begin(),
                             instances[i]->slots[s].numbers.end());
        function.slot_texts[s] = slot.is_table ? std::to_string(offset) : fmt::format("pt_number(at + {})", offset);
        written.push_back(s);
    }
    function.lookup_offset = std::to_string(blocks[0].size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        blocks[i].insert(blocks[i].end(), instances[i]->data.begin(), instances[i]->data.end());
        function.takes_offset = function.takes_offset || !blocks[i].empty();
        instances[i]->at = offset_of_block(blocks[i]);
        instances[i]->slots.clear();
        instances[i]->data.clear();
    }
}

std::uint32_t Functions::offset_of_block(const std::vector<float>& block) {
    if (block.empty()) return 0;
    const auto [known, is_new] = blocks_.try_emplace(bits_of(block), static_cast<std::uint32_t>(numbers_.size()));
    if (is_new) numbers_.insert(numbers_.end(), block.begin(), block.end());
    return known->second;
}

std::string Functions::filled(const Function& function, const std::string& text) const {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\x01') {
            result += text[i];
            continue;
        }
        const std::size_t end = text.find('\x02', i);
        const std::string slot = text.substr(i + 1, end - i - 1);
        result += slot == "L" ? function.lookup_offset : function.slot_texts[std::stoul(slot)];
        i = end;
    }
    return result;
}

std::string Functions::call(std::uint32_t instruction, std::span<const std::string> arguments,
                            bool with_gradients) const {
    const Instance& instance = instances_[instruction];
    return call_at(instance.function, arguments, std::to_string(instance.at), with_gradients);
}

std::string Functions::call_at(std::uint32_t number, std::span<const std::string> arguments, const std::string& at,
                               bool with_gradients) const {
    const Function& function = functions_[number];
    const std::string body = filled(function, with_gradients ? function.text.dual_body : function.text.float_body);
    if (!takes_point(function.op) && is_expression(body) && !function.takes_offset)
        return with_arguments(body.substr(returned.size(), body.size() - returned.size() - 2), arguments);
    std::string list;
    for (const std::string& a : arguments) list += (list.empty() ? "" : ", ") + a;
    if (function.takes_offset) list += ", " + at;
    return fmt::format("{}{}({})", with_gradients ? "pt_d_" + function.name.substr(3) : function.name, "", list);
}

std::string Functions::text(bool with_gradients) const {
    std::string result;
    const char* const number = with_gradients ? "vec4" : "float";
    const char* const point = with_gradients ? "mat3x4" : "vec3";
    std::vector<SharedFunction> called;
    const auto add_called = [&](const FunctionText& text) {
        for (const SharedFunction f : text.calls)
            if (std::ranges::find(called, f) == called.end()) called.push_back(f);
    };
    for (const Function& f : functions_) add_called(f.text);
    for (std::size_t i = 0; i < called.size(); ++i) add_called(text_of(trace_of(called[i])));
    std::string shared;
    for (const SharedFunction f : called) {
        const Trace trace = trace_of(f);
        Function function{{}, {}, text_of(trace), false, {}, {}};
        for (const NumberSlot& s : function.text.slots) function.slot_texts.push_back(literal(s.numbers[0]));
        // Callees are defined before their callers.
        std::string parameters;
        for (std::uint32_t k = 0; k < trace.inputs; ++k)
            parameters += fmt::format("{}{} {}", k > 0 ? ", " : "", number, static_cast<char>('x' + k));
        std::string body = filled(function, with_gradients ? function.text.dual_body : function.text.float_body);
        if (with_gradients && f == SharedFunction::angle)
            body =
                "    float s = x.w * x.w + y.w * y.w;\n"
                "    return vec4((x.w * y.xyz - y.w * x.xyz) * (s > 0.0 ? 1.0 / s : 0.0), pt_angle_of(x.w, y.w));\n";
        shared = fmt::format("{} {}{}({}) {{\n{}}}\n", number, with_gradients ? "pt_d_" : "pt_", glsl::name_of(f),
                             parameters, body) +
                 shared;
    }
    result += shared;
    for (const Function& f : functions_) {
        const std::string body = filled(f, with_gradients ? f.text.dual_body : f.text.float_body);
        if (!takes_point(f.op) && is_expression(body) && !f.takes_offset) continue;
        const int inputs = takes_point(f.op) ? 3 : operands(f.op);
        std::string parameters;
        for (int k = 0; k < inputs; ++k)
            parameters += fmt::format("{}{} {}", k > 0 ? ", " : "", number, static_cast<char>('x' + k));
        if (f.takes_offset) parameters += ", int at";
        result += fmt::format("{} {}({}) {{\n{}}}\n", gives_point(f.op) ? point : number,
                              with_gradients ? "pt_d_" + f.name.substr(3) : f.name, parameters, body);
    }
    return result;
}

}  // namespace phasetree::glsl
