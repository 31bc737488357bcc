#include "glsl/function_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glsl/loops.hpp"
#include "glsl/readings.hpp"

namespace phasetree::glsl {

namespace {

constexpr std::size_t longest_expression = 100;
const char* const input_names[] = {"x", "y", "z"};

// The GLSL text of a value.
struct Expression {
    std::string text;
    bool has_gradient = false;
    bool is_stable = true;  // The text has the same value anywhere later in the iteration.
};

// Writes one body of a function, which computes with floats or dual numbers. Names in the text: v is the variable of a
// leaf, c a carried variable, g an array filled by leaves, and i a loop counter.
class FunctionWriter {
  public:
    FunctionWriter(const Nest& nest, const Readings& readings, bool is_dual, FunctionText& text)
        : nest_(nest), readings_(readings), is_dual_(is_dual), text_(text) {
        find_what_needs_a_variable();
        find_gradients();
        expressions_.resize(nest.leaves().size());
    }

    std::string write() {
        declare();
        std::size_t leaf = 0;
        std::vector<const NestItem*> loops;
        write_items(nest_.items(), leaf, loops);
        const auto& results = readings_.results;
        std::vector<std::string> texts;
        for (const Reading& r : results) {
            texts.push_back(fitted(expression(r, {}), is_dual_));
        }
        if (results.size() == 1)
            line("return {};", texts[0]);
        else
            line("return {}({}, {}, {});", is_dual_ ? "mat3x4" : "vec3", texts[0], texts[1], texts[2]);
        return std::move(out_);
    }

  private:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        out_.append(4 * (depth_ + 1), ' ');
        out_ += fmt::format(format, std::forward<Args>(args)...);
        out_ += '\n';
    }

    // Counts the readers of each leaf. Being carried or stored counts twice, so that such a leaf gets a variable
    // instead of being inlined in its reader's expression.
    void find_what_needs_a_variable() {
        uses_.assign(nest_.leaves().size(), 0);
        const auto use = [&](const Reading& r) {
            if (r.kind == Reading::Kind::leaf) ++uses_[r.index];
        };
        for (const auto& operands : readings_.of)
            for (const Reading& r : operands) use(r);
        for (const Reading& r : readings_.results) use(r);
        for (const CarriedVariable& c : readings_.carried) {
            use(c.start);
            uses_[c.leaf] += 2;
        }
        for (std::size_t i = 0; i < uses_.size(); ++i) uses_[i] += 2 * static_cast<int>(readings_.writes[i].size());
    }

    // Finds the leaves, carried variables and arrays that depend on the inputs and so have gradients. A loop may feed
    // its results back, so this is repeated until nothing changes.
    void find_gradients() {
        leaf_gradient_.assign(nest_.leaves().size(), 0);
        carried_gradient_.assign(readings_.carried.size(), 0);
        array_gradient_.assign(readings_.arrays.size(), 0);
        if (!is_dual_) return;
        for (const auto& writes : readings_.inputs)
            for (const ElementWrite& w : writes) array_gradient_[w.array] = 1;
        for (bool changes = true; changes;) {
            changes = false;
            const auto set = [&](char& flag, bool to) {
                if (to && !flag) flag = changes = true;
            };
            for (std::size_t i = 0; i < leaf_gradient_.size(); ++i) {
                const TraceStep& s = step(i);
                const auto& in = readings_.of[i];
                const std::size_t first = s.op == TraceOp::select ? 1 : 0;
                const bool has_no_slope = s.op == TraceOp::floor || s.op == TraceOp::less || s.op == TraceOp::lookup;
                for (std::size_t k = first; k < in.size() && !has_no_slope; ++k)
                    set(leaf_gradient_[i], has_gradient(in[k]));
                for (const ElementWrite& w : readings_.writes[i]) set(array_gradient_[w.array], leaf_gradient_[i]);
            }
            for (std::size_t c = 0; c < carried_gradient_.size(); ++c) {
                const CarriedVariable& v = readings_.carried[c];
                set(carried_gradient_[c], leaf_gradient_[v.leaf] || has_gradient(v.start));
            }
        }
    }
    bool has_gradient(const Reading& r) const {
        switch (r.kind) {
            case Reading::Kind::input:
                return is_dual_;
            case Reading::Kind::leaf:
                return leaf_gradient_[r.index];
            case Reading::Kind::carried:
                return carried_gradient_[r.index];
            case Reading::Kind::element:
                return array_gradient_[r.index];
            case Reading::Kind::number:
            case Reading::Kind::table:
                break;
        }
        return false;
    }
    const TraceStep& step(std::size_t leaf) const { return nest_.trace().steps[nest_.leaves()[leaf].first]; }
    const char* type(std::size_t leaf) const {
        return step(leaf).op == TraceOp::less ? "bool" : leaf_gradient_[leaf] ? "vec4" : "float";
    }

    void declare() {
        for (std::size_t i = 0; i < readings_.escapes.size(); ++i)
            if (readings_.escapes[i]) line("{} v{};", type(i), i);
        for (std::size_t c = 0; c < readings_.carried.size(); ++c)
            line("{} c{};", carried_gradient_[c] ? "vec4" : "float", c);
        for (std::size_t a = 0; a < readings_.arrays.size(); ++a)
            line("{} g{}[{}];", array_gradient_[a] ? "vec4" : "float", a, readings_.arrays[a].size());
        for (std::size_t i = 0; i < readings_.inputs.size(); ++i)
            for (const ElementWrite& w : readings_.inputs[i])
                line("g{}[{}] = {};", w.array, w.first - readings_.arrays[w.array].lowest,
                     fitted({input_names[i], is_dual_}, array_gradient_[w.array]));
    }

    void write_items(const std::vector<NestItem>& items, std::size_t& leaf, std::vector<const NestItem*>& loops) {
        for (const NestItem& item : items) {
            if (item.is_step()) {
                write_leaf(leaf++);
                continue;
            }
            for (std::size_t c = 0; c < readings_.carried.size(); ++c) {
                const CarriedVariable& v = readings_.carried[c];
                if (v.loop == &item) line("c{} = {};", c, fitted(expression(v.start, loops), carried_gradient_[c]));
            }
            const std::size_t depth = loops.size();
            line("for (int i{0} = 0; i{0} < {1}; ++i{0}) {{", depth, item.count);
            ++depth_;
            loops.push_back(&item);
            write_items(item.body, leaf, loops);
            loops.pop_back();
            --depth_;
            line("}}");
        }
    }

    void write_leaf(std::size_t i) {
        const std::vector<const NestItem*>& loops = nest_.leaves()[i].loops;
        Expression e = computed(i, loops);
        const bool is_inlined = uses_[i] == 1 && !readings_.escapes[i] && e.is_stable &&
                                e.text.size() < longest_expression && is_read_in_same_iteration(i);
        if (!is_inlined) {
            if (uses_[i] > 0) line("{}v{} = {};", readings_.escapes[i] ? "" : std::string(type(i)) + " ", i, e.text);
            e.text = fmt::format("v{}", i);
            e.is_stable = !readings_.escapes[i];
        }
        // A carried read always refers to the latest value (readings.cpp), so nothing later needs the previous one.
        for (std::size_t c = 0; c < readings_.carried.size(); ++c)
            if (readings_.carried[c].leaf == i) line("c{} = {};", c, fitted(e, carried_gradient_[c]));
        for (const ElementWrite& w : readings_.writes[i]) {
            std::string index = std::to_string(w.first - readings_.arrays[w.array].lowest);
            for (std::size_t l = 0; l < w.factors.size(); ++l)
                if (w.factors[l] != 0) index += fmt::format(" + ({}) * i{}", w.factors[l], l);
            line("g{}[{}] = {};", w.array, index, fitted(e, array_gradient_[w.array]));
        }
        expressions_[i] = std::move(e);
    }
    // Whether the single reader of a leaf is in the same iteration, and not in an inner loop.
    bool is_read_in_same_iteration(std::size_t i) const {
        const auto reads = [&](const Reading& r) { return r.kind == Reading::Kind::leaf && r.index == i; };
        for (std::size_t k = 0; k < readings_.of.size(); ++k)
            if (std::ranges::any_of(readings_.of[k], reads)) return nest_.leaves()[k].loops == nest_.leaves()[i].loops;
        return nest_.leaves()[i].loops.empty() && std::ranges::any_of(readings_.results, reads);
    }

    Expression expression(const Reading& r, const std::vector<const NestItem*>& loops) {
        switch (r.kind) {
            case Reading::Kind::input:
                return {input_names[r.index], is_dual_};
            case Reading::Kind::leaf:
                return expressions_[r.index];
            case Reading::Kind::carried:
                return {fmt::format("c{}", r.index), carried_gradient_[r.index] != 0, false};
            case Reading::Kind::element:
                return {fmt::format("g{}[{}{}]", r.index, index_text(r, loops),
                                    offset_from(readings_.arrays[r.index].lowest)),
                        array_gradient_[r.index] != 0, false};
            case Reading::Kind::number:
            case Reading::Kind::table:
                break;
        }
        const bool is_table = r.kind == Reading::Kind::table;
        text_.slots.push_back({r.numbers, is_table});
        const std::string slot = fmt::format("\x01{}\x02", text_.slots.size() - 1);
        return {is_table ? fmt::format("pt_number(at + {} + {})", slot, index_text(r, loops)) : slot};
    }
    // Writes the index into a table or an array in row-major order: the last counter varies fastest.
    static std::string index_text(const Reading& r, const std::vector<const NestItem*>& loops) {
        std::string text;
        std::size_t stride = 1;
        for (std::size_t k = r.counters.size(); k-- > 0;) {
            const std::uint32_t l = r.counters[k];
            const std::string term = stride == 1 ? fmt::format("i{}", l) : fmt::format("{} * i{}", stride, l);
            text = text.empty() ? term : fmt::format("{} + {}", term, text);
            stride *= loops[l]->count;
        }
        return text.empty() ? "0" : text;
    }
    // The first element of an array has its lowest index, which is never above 0.
    static std::string offset_from(std::int64_t lowest) { return lowest < 0 ? fmt::format(" + {}", -lowest) : ""; }
    static std::string fitted(const Expression& e, bool to_dual) {
        return to_dual && !e.has_gradient ? fmt::format("vec4(0.0, 0.0, 0.0, {})", e.text) : e.text;
    }

    Expression computed(std::size_t i, const std::vector<const NestItem*>& loops) {
        const TraceStep& s = step(i);
        std::vector<Expression> in;
        for (const Reading& r : readings_.of[i]) in.push_back(expression(r, loops));
        Expression result;
        result.has_gradient = leaf_gradient_[i];
        for (const Expression& e : in) result.is_stable = result.is_stable && e.is_stable;
        result.text = result.has_gradient ? dual_expression(s, in) : float_expression(s, in);
        return result;
    }
    // Comparisons and similar operations use only the values.
    static std::string value(const Expression& e) { return e.has_gradient ? e.text + ".w" : e.text; }

    std::string float_expression(const TraceStep& s, const std::vector<Expression>& in) {
        const auto a = [&](std::size_t k) { return value(in[k]); };
        switch (s.op) {
            case TraceOp::negate:
                return fmt::format("(-{})", a(0));
            case TraceOp::add:
                return fmt::format("({} + {})", a(0), a(1));
            case TraceOp::subtract:
                return fmt::format("({} - {})", a(0), a(1));
            case TraceOp::multiply:
                return fmt::format("({} * {})", a(0), a(1));
            case TraceOp::divide:
                return fmt::format("({} / {})", a(0), a(1));
            case TraceOp::less:
                return fmt::format("({} < {})", a(0), a(1));
            case TraceOp::select:
                return fmt::format("({} ? {} : {})", in[0].text, a(1), a(2));
            case TraceOp::minimum:
                return fmt::format("min({}, {})", a(0), a(1));
            case TraceOp::maximum:
                return fmt::format("max({}, {})", a(0), a(1));
            case TraceOp::absolute:
                return fmt::format("abs({})", a(0));
            case TraceOp::root:
                return fmt::format("sqrt({})", a(0));
            case TraceOp::floor:
                return fmt::format("floor({})", a(0));
            case TraceOp::lookup:
                text_.has_lookup = true;
                return fmt::format("pt_number(at + \x01L\x02 + {} + int({}))", s.table, a(0));
            case TraceOp::call:
                break;
        }
        return call(s, in, false);
    }
    std::string dual_expression(const TraceStep& s, const std::vector<Expression>& in) {
        const auto a = [&](std::size_t k) { return in[k].text; };
        const auto dual = [&](std::size_t k) { return fitted(in[k], true); };
        switch (s.op) {
            case TraceOp::negate:
                return fmt::format("(-{})", a(0));
            case TraceOp::add:
                return fmt::format("pt_d_add({}, {})", a(0), a(1));
            case TraceOp::subtract:
                return fmt::format("pt_d_sub({}, {})", a(0), a(1));
            case TraceOp::multiply:
                return fmt::format("pt_d_mul({}, {})", a(0), a(1));
            case TraceOp::divide:
                return fmt::format("pt_d_div({}, {})", dual(0), dual(1));
            case TraceOp::select:
                return fmt::format("({} ? {} : {})", in[0].text, dual(1), dual(2));
            case TraceOp::minimum:
                return fmt::format("pt_d_min({}, {})", dual(0), dual(1));
            case TraceOp::maximum:
                return fmt::format("pt_d_max({}, {})", dual(0), dual(1));
            case TraceOp::absolute:
                return fmt::format("pt_d_abs({})", a(0));
            case TraceOp::root:
                return fmt::format("pt_d_sqrt({})", a(0));
            case TraceOp::less:
            case TraceOp::floor:
            case TraceOp::lookup:
            case TraceOp::call:
                break;
        }
        return call(s, in, true);
    }
    std::string call(const TraceStep& s, const std::vector<Expression>& in, bool to_dual) {
        if (s.op != TraceOp::call || s.function == SharedFunction::none)
            throw std::logic_error("GLSL: a step has no form with gradients");
        if (std::ranges::find(text_.calls, s.function) == text_.calls.end()) text_.calls.push_back(s.function);
        std::string arguments;
        for (const Expression& e : in)
            arguments += (arguments.empty() ? "" : ", ") + (to_dual ? fitted(e, true) : value(e));
        return fmt::format("{}{}({})", to_dual ? "pt_d_" : "pt_", name_of(s.function), arguments);
    }

    const Nest& nest_;
    const Readings& readings_;
    bool is_dual_;
    FunctionText& text_;
    std::string out_;
    std::size_t depth_ = 0;
    std::vector<int> uses_;
    std::vector<char> leaf_gradient_, carried_gradient_, array_gradient_;
    std::vector<Expression> expressions_;
};

}  // namespace

FunctionText text_of(const Trace& trace) {
    Nest nest(trace, find_loops(trace));
    auto readings = readings_of(nest);
    if (!readings) {
        // The loops that were found cannot be written, so write the function without loops.
        std::vector<NestItem> steps;
        for (std::uint32_t i = 0; i < trace.steps.size(); ++i) steps.push_back({i, 1, 1, {}});
        nest = Nest(trace, std::move(steps));
        readings = readings_of(nest);
        if (!readings) throw std::logic_error("GLSL: a function cannot be written without loops");
    }
    FunctionText text;
    text.float_body = FunctionWriter(nest, *readings, false, text).write();
    text.dual_body = FunctionWriter(nest, *readings, true, text).write();
    return text;
}

const char* name_of(SharedFunction function) {
    switch (function) {
        case SharedFunction::sine:
            return "sine";
        case SharedFunction::sine_of_pair:
            return "sine_of_pair";
        case SharedFunction::cosine_of_pair:
            return "cosine_of_pair";
        case SharedFunction::angle:
            return "angle_of";
        case SharedFunction::space_noise:
            return "value_noise";
        case SharedFunction::none:
            break;
    }
    return "";
}

std::string literal(float v) {
    if (std::isnan(v)) return "uintBitsToFloat(0x7fc00000u)";
    if (std::isinf(v)) return v > 0 ? "uintBitsToFloat(0x7f800000u)" : "uintBitsToFloat(0xff800000u)";
    std::string text = fmt::format("{}", v);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return std::signbit(v) ? "(" + text + ")" : text;
}

}  // namespace phasetree::glsl
