// From the text of a formula to steps:
//
//   formula  = { name "=" sum ";" } sum
//   sum      = product { ("+" | "-") product }
//   product  = signed { ("*" | "/") signed }
//   signed   = { "+" | "-" } power
//   power    = atom [ "^" exponent ]
//   exponent = { "+" | "-" } number
//   atom     = number | name | name "(" sum { "," sum } ")" | "(" sum ")"

#include "nodes/formula_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <tuple>

#include "model/text_error.hpp"

namespace phasetree::nodes {

using formula::Op;

int operands(Op op) {
    switch (op) {
        case Op::x:
        case Op::y:
        case Op::z:
        case Op::constant:
            return 0;
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::length_of_two:
        case Op::minimum:
        case Op::maximum:
        case Op::smooth_minimum:
            return 2;
        case Op::length_of_three:
            return 3;
        default:
            return 1;
    }
}

namespace {

constexpr std::size_t longest_text = 20'000, most_steps = 2'000;
constexpr std::size_t most_squares = 16;
constexpr int deepest = 100;

using Index = std::uint32_t;

[[noreturn]] void fail(std::size_t offset, const std::string& message) {
    throw TextError(std::string(Formula::info.name), "text", offset, message);
}

// Steps, each once; simpler ones where that is possible.
class Builder {
  public:
    const FormulaStep& operator[](Index i) const { return steps_[i]; }
    void stand_at(std::size_t offset) { offset_ = offset; }

    Index constant(double v) {
        if (!(std::abs(v) < 1e30)) fail(offset_, "a number is too large, or none");
        return emit({.op = Op::constant, .value = v});
    }
    Index coordinate(Op op) { return emit({.op = op}); }

    Index add(Index a, Index b) {
        if (are_constant(a, b)) return constant(value(a) + value(b));
        if (is(a, 0)) return b;
        if (is(b, 0)) return a;
        return emit({.op = Op::add, .a = a, .b = b});
    }
    Index subtract(Index a, Index b) {
        if (are_constant(a, b)) return constant(value(a) - value(b));
        if (a == b) return constant(0);
        if (is(a, 0)) return negate(b);
        if (is(b, 0)) return a;
        return emit({.op = Op::subtract, .a = a, .b = b});
    }
    Index negate(Index a) {
        if (is_constant(a)) return constant(-value(a));
        if (steps_[a].op == Op::negate) return steps_[a].a;
        return emit({.op = Op::negate, .a = a});
    }
    Index multiply(Index a, Index b) {
        if (are_constant(a, b)) return constant(value(a) * value(b));
        if (is_constant(b)) std::swap(a, b);
        if (is(a, 0)) return a;
        if (is(a, 1)) return b;
        if (is(a, -1)) return negate(b);
        if (a == b) return emit({.op = Op::square, .a = a});
        return emit({.op = Op::multiply, .a = a, .b = b});
    }
    Index divide(Index a, Index b) {
        if (is(b, 0)) fail(offset_, "this divides by zero");
        if (is_constant(b)) return multiply(constant(1 / value(b)), a);
        return emit({.op = Op::divide, .a = a, .b = b});
    }
    Index power(Index a, double n) {
        if (n == 0.5) return square_root(a);
        if (n != std::floor(n) || std::abs(n) > 64)
            fail(offset_, "an exponent is a whole number from -64 to 64, or 0.5");
        if (n < 0) return divide(constant(1), power(a, -n));
        if (n == 0) return constant(1);
        const Index half = power(a, std::floor(n / 2));
        const Index even = n < 2 ? constant(1) : multiply(half, half);
        return std::fmod(n, 2) == 0 ? even : multiply(even, a);
    }
    Index square_root(Index a) {
        if (is_constant(a)) {
            if (value(a) < 0) fail(offset_, "this is the root of a negative number");
            return constant(std::sqrt(value(a)));
        }
        std::vector<Index> sides;
        if (!collect_squares(a, sides)) return emit({.op = Op::square_root, .a = a});
        Index length = sides[0];
        for (std::size_t i = 1; i < sides.size(); i += 2)
            length = i + 1 < sides.size() ? length_of(length, sides[i], sides[i + 1]) : length_of(length, sides[i]);
        return sides.size() == 1 ? absolute(length) : length;
    }
    Index length_of(Index a, Index b) { return emit({.op = Op::length_of_two, .a = a, .b = b}); }
    Index length_of(Index a, Index b, Index c) { return emit({.op = Op::length_of_three, .a = a, .b = b, .c = c}); }
    Index absolute(Index a) {
        if (is_constant(a)) return constant(std::abs(value(a)));
        return emit({.op = Op::absolute, .a = a});
    }
    Index minimum(Index a, Index b) {
        if (are_constant(a, b)) return constant(std::min(value(a), value(b)));
        return a == b ? a : emit({.op = Op::minimum, .a = a, .b = b});
    }
    Index maximum(Index a, Index b) {
        if (are_constant(a, b)) return constant(std::max(value(a), value(b)));
        return a == b ? a : emit({.op = Op::maximum, .a = a, .b = b});
    }
    Index smooth_minimum(Index a, Index b, Index radius) {
        if (!is_constant(radius) || !(value(radius) > 1e-6))
            fail(offset_, "the radius of a smooth minimum or maximum must be a positive number");
        return emit({.op = Op::smooth_minimum, .a = a, .b = b, .value = value(radius)});
    }
    Index function(Op op, Index a, double (*of)(double)) {
        return is_constant(a) ? constant(of(value(a))) : emit({.op = op, .a = a});
    }

    // What the result needs, in its order.
    std::vector<FormulaStep> needed_for(Index result) const {
        std::vector<char> is_needed(steps_.size(), 0);
        is_needed[result] = 1;
        for (Index i = result + 1; i-- > 0;) {
            if (!is_needed[i]) continue;
            const FormulaStep& s = steps_[i];
            const std::array<Index, 3> of{s.a, s.b, s.c};
            for (int k = 0; k < operands(s.op); ++k) is_needed[of[static_cast<std::size_t>(k)]] = 1;
        }
        std::vector<Index> place(steps_.size(), 0);
        std::vector<FormulaStep> needed;
        for (Index i = 0; i <= result; ++i) {
            if (!is_needed[i]) continue;
            place[i] = static_cast<Index>(needed.size());
            FormulaStep s = steps_[i];
            s.a = place[s.a];
            s.b = place[s.b];
            s.c = place[s.c];
            needed.push_back(s);
        }
        return needed;
    }

  private:
    using Key = std::tuple<Op, Index, Index, Index, double>;

    Index emit(FormulaStep s) {
        s.offset = offset_;
        const Key key{s.op, s.a, s.b, s.c, s.value};
        if (const auto found = known_.find(key); found != known_.end()) return found->second;
        if (steps_.size() == most_steps) fail(offset_, "the formula has more than 2000 operations");
        const auto index = static_cast<Index>(steps_.size());
        steps_.push_back(s);
        known_.emplace(key, index);
        return index;
    }
    bool is_constant(Index i) const { return steps_[i].op == Op::constant; }
    bool are_constant(Index a, Index b) const { return is_constant(a) && is_constant(b); }
    bool is(Index i, double v) const { return is_constant(i) && steps_[i].value == v; }
    double value(Index i) const { return steps_[i].value; }

    // Whether a value is a sum of a few squares, and of what. Shared parts could make many of few steps.
    bool collect_squares(Index i, std::vector<Index>& sides, int depth = 0) {
        const FormulaStep s = steps_[i];
        if (depth > deepest || sides.size() > most_squares) return false;
        if (s.op == Op::add) return collect_squares(s.a, sides, depth + 1) && collect_squares(s.b, sides, depth + 1);
        if (s.op == Op::square) {
            sides.push_back(s.a);
        } else if (s.op == Op::constant && s.value >= 0) {
            sides.push_back(constant(std::sqrt(s.value)));
        } else if (s.op == Op::multiply && is_constant(s.a) && value(s.a) >= 0 && steps_[s.b].op == Op::square) {
            sides.push_back(multiply(constant(std::sqrt(value(s.a))), steps_[s.b].a));
        } else {
            return false;
        }
        return true;
    }

    std::vector<FormulaStep> steps_;
    std::map<Key, Index> known_;
    std::size_t offset_ = 0;
};

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

class FormulaReader {
  public:
    explicit FormulaReader(const std::string& text) : text_(text) {}

    std::vector<FormulaStep> read() {
        if (text_.size() > longest_text) fail(longest_text, "the formula is longer than 20000 characters");
        names_ = {{"x", steps_.coordinate(Op::x)},
                  {"y", steps_.coordinate(Op::y)},
                  {"z", steps_.coordinate(Op::z)},
                  {"pi", steps_.constant(std::numbers::pi)}};
        while (assignment()) {
        }
        const Index result = sum();
        blanks();
        if (at_ < text_.size()) fail(at_, "an operator or the end is expected here" + found());
        return steps_.needed_for(result);
    }

  private:
    struct Level {
        explicit Level(FormulaReader& reader) : depth(reader.depth_) {
            if (++depth > deepest) fail(reader.at_, "the formula is nested more than 100 levels deep");
        }
        ~Level() { --depth; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        int& depth;
    };

    void blanks() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }
    bool accept(char c) {
        blanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!accept(c)) fail(at_, std::string("\"") + c + "\" is expected here" + found());
    }
    std::string found() const {
        if (at_ >= text_.size()) return ", but the text ends";
        const char c = text_[at_];
        return c > ' ' && c < 127 ? std::string(", but there is \"") + c + "\"" : "";
    }
    std::string_view name() {
        blanks();
        const std::size_t from = at_;
        while (at_ < text_.size() && (is_letter(text_[at_]) || (at_ > from && is_digit(text_[at_])))) ++at_;
        return std::string_view(text_).substr(from, at_ - from);
    }

    // A name that is given to a value.
    bool assignment() {
        blanks();
        const std::size_t from = at_;
        const std::string_view word = name();
        if (word.empty() || !accept('=')) {
            at_ = from;
            return false;
        }
        if (names_.contains(word) || is_function(word))
            fail(from, "\"" + std::string(word) + "\" means something already");
        const Index value = sum();
        expect(';');
        names_.emplace(word, value);
        return true;
    }
    Index sum() {
        Index left = product();
        while (true) {
            blanks();
            const std::size_t place = at_;
            if (accept('+')) {
                const Index right = product();
                steps_.stand_at(place);
                left = steps_.add(left, right);
            } else if (accept('-')) {
                const Index right = product();
                steps_.stand_at(place);
                left = steps_.subtract(left, right);
            } else {
                return left;
            }
        }
    }
    Index product() {
        Index left = with_sign();
        while (true) {
            blanks();
            const std::size_t place = at_;
            if (accept('*')) {
                const Index right = with_sign();
                steps_.stand_at(place);
                left = steps_.multiply(left, right);
            } else if (accept('/')) {
                const Index right = with_sign();
                steps_.stand_at(place);
                left = steps_.divide(left, right);
            } else {
                return left;
            }
        }
    }
    Index with_sign() {
        bool is_negative = false;
        while (true) {
            if (accept('-'))
                is_negative = !is_negative;
            else if (!accept('+'))
                break;
        }
        const std::size_t place = at_;
        const Index value = power();
        if (!is_negative) return value;
        steps_.stand_at(place);
        return steps_.negate(value);
    }
    Index power() {
        const Index base = atom();
        blanks();
        const std::size_t place = at_;
        if (!accept('^')) return base;
        double sign = 1;
        while (true) {
            if (accept('-'))
                sign = -sign;
            else if (!accept('+'))
                break;
        }
        blanks();
        if (at_ >= text_.size() || !(is_digit(text_[at_]) || text_[at_] == '.'))
            fail(at_, "an exponent must be a number" + found());
        const double exponent = sign * number();
        steps_.stand_at(place);
        return steps_.power(base, exponent);
    }
    double number() {
        double value = 0;
        const char* const from = text_.data() + at_;
        const auto [end, error] = std::from_chars(from, text_.data() + text_.size(), value);
        if (error != std::errc()) fail(at_, "this number cannot be read");
        steps_.stand_at(at_);
        at_ += static_cast<std::size_t>(end - from);
        return value;
    }
    Index atom() {
        const Level level(*this);
        blanks();
        const std::size_t place = at_;
        if (accept('(')) {
            const Index inner = sum();
            expect(')');
            return inner;
        }
        if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return steps_.constant(number());
        const std::string_view word = name();
        if (word.empty()) fail(at_, "a number, a name or \"(\" is expected here" + found());
        if (accept('(')) return call(word, place);
        if (const auto known = names_.find(word); known != names_.end()) return known->second;
        fail(place, is_function(word) ? "\"" + std::string(word) + "\" is a function: (…) is missing behind it"
                                      : "there is no name \"" + std::string(word) + "\"; there are " + all_names());
    }
    std::string all_names() const {
        std::string all;
        for (const auto& [word, index] : names_) all += (all.empty() ? "" : ", ") + std::string(word);
        return all;
    }

    struct Function {
        std::string_view name;
        std::size_t least, most;  // arguments
        Index (*apply)(Builder&, const std::vector<Index>&);
    };
    static std::span<const Function> functions();
    static const Function* function_of(std::string_view word) {
        const auto all = functions();
        const auto found = std::ranges::find(all, word, &Function::name);
        return found == all.end() ? nullptr : &*found;
    }
    static bool is_function(std::string_view word) { return function_of(word) != nullptr; }

    Index call(std::string_view word, std::size_t place) {
        const Function* const function = function_of(word);
        if (!function) {
            std::string all;
            for (const Function& f : functions()) all += (all.empty() ? "" : ", ") + std::string(f.name);
            fail(place, "there is no function \"" + std::string(word) + "\"; there are " + all);
        }
        std::vector<Index> arguments;
        do arguments.push_back(sum());
        while (accept(','));
        expect(')');
        if (arguments.size() < function->least || arguments.size() > function->most)
            fail(place, "\"" + std::string(word) + "\" takes " + std::to_string(function->least) +
                            (function->most == function->least ? ""
                             : function->most > 100            ? " or more"
                                                               : " to " + std::to_string(function->most)) +
                            (function->most == 1 ? " argument" : " arguments") + ", but has " +
                            std::to_string(arguments.size()));
        steps_.stand_at(place);
        return function->apply(steps_, arguments);
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    Builder steps_;
    std::map<std::string_view, Index> names_;
};

std::span<const FormulaReader::Function> FormulaReader::functions() {
    using Values = const std::vector<Index>&;
    static constexpr std::size_t any = 1000;
    static const std::array<Function, 15> all{{
        {"sqrt", 1, 1, [](Builder& s, Values v) { return s.square_root(v[0]); }},
        {"abs", 1, 1, [](Builder& s, Values v) { return s.absolute(v[0]); }},
        {"min", 2, any,
         [](Builder& s, Values v) {
             Index least = v[0];
             for (std::size_t i = 1; i < v.size(); ++i) least = s.minimum(least, v[i]);
             return least;
         }},
        {"max", 2, any,
         [](Builder& s, Values v) {
             Index most = v[0];
             for (std::size_t i = 1; i < v.size(); ++i) most = s.maximum(most, v[i]);
             return most;
         }},
        {"sin", 1, 1, [](Builder& s, Values v) { return s.function(Op::sine, v[0], std::sin); }},
        {"cos", 1, 1, [](Builder& s, Values v) { return s.function(Op::cosine, v[0], std::cos); }},
        {"tan", 1, 1,
         [](Builder& s, Values v) {
             const Index sine = s.function(Op::sine, v[0], std::sin);
             return s.divide(sine, s.function(Op::cosine, v[0], std::cos));
         }},
        {"exp", 1, 1, [](Builder& s, Values v) { return s.function(Op::exponential, v[0], std::exp); }},
        {"tanh", 1, 1,
         [](Builder& s, Values v) {  // 1 − 2/(e²ᵃ + 1)
             const Index e = s.function(Op::exponential, s.multiply(s.constant(2), v[0]), std::exp);
             return s.subtract(s.constant(1), s.divide(s.constant(2), s.add(e, s.constant(1))));
         }},
        {"length", 2, 3,
         [](Builder& s, Values v) { return v.size() == 2 ? s.length_of(v[0], v[1]) : s.length_of(v[0], v[1], v[2]); }},
        {"clamp", 3, 3, [](Builder& s, Values v) { return s.minimum(s.maximum(v[0], v[1]), v[2]); }},
        {"smooth_min", 3, 3, [](Builder& s, Values v) { return s.smooth_minimum(v[0], v[1], v[2]); }},
        {"smooth_max", 3, 3,
         [](Builder& s, Values v) { return s.negate(s.smooth_minimum(s.negate(v[0]), s.negate(v[1]), v[2])); }},
        {"square", 1, 1, [](Builder& s, Values v) { return s.multiply(v[0], v[0]); }},
        {"pow", 2, 2,
         [](Builder& s, Values v) {
             if (s[v[1]].op != Op::constant) fail(s[v[1]].offset, "an exponent must be a number");
             return s.power(v[0], s[v[1]].value);
         }},
    }};
    return all;
}

}  // namespace

std::vector<FormulaStep> read_formula(const std::string& text) {
    return FormulaReader(text).read();
}

}  // namespace phasetree::nodes
