// From the text of a formula to steps:
//
//   formula  = { name "=" sum ";" } sum
//   sum      = product { ("+" | "-") product }
//   product  = signed { ("*" | "/") signed }
//   signed   = { "+" | "-" } power
//   power    = atom [ "^" exponent ]
//   exponent = { "+" | "-" } number
//   atom     = number | name | name "(" sum { "," sum } ")" | "(" sum ")"

#include "nodes/formula/text.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <numbers>
#include <string_view>

#include "nodes/formula/functions.hpp"

namespace phasetree::nodes {

using formula::Op;

namespace {

constexpr std::size_t longest_text = 20'000;

using Index = FormulaIndex;

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
        if (text_.size() > longest_text) fail_in_formula(longest_text, "the formula is longer than 20000 characters");
        names_ = {{"x", steps_.coordinate(Op::x)},
                  {"y", steps_.coordinate(Op::y)},
                  {"z", steps_.coordinate(Op::z)},
                  {"pi", steps_.constant(std::numbers::pi)}};
        while (assignment()) {
        }
        const Index result = sum();
        blanks();
        if (at_ < text_.size()) fail_in_formula(at_, "expected an operator or the end" + found());
        return steps_.needed_for(result);
    }

  private:
    struct Level {
        explicit Level(FormulaReader& reader) : depth(reader.depth_) {
            if (++depth > deepest_formula)
                fail_in_formula(reader.at_, "the formula is nested more than 100 levels deep");
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
        if (!accept(c)) fail_in_formula(at_, std::string("\"") + c + "\" is expected here" + found());
    }
    std::string found() const {
        if (at_ >= text_.size()) return ", but the text ends";
        const char c = text_[at_];
        return c > ' ' && c < 127 ? std::string(", but there is \"") + c + "\"" : "";
    }
    std::string_view name() {
        blanks();
        const std::size_t begin = at_;
        while (at_ < text_.size() && (is_letter(text_[at_]) || (at_ > begin && is_digit(text_[at_])))) ++at_;
        return std::string_view(text_).substr(begin, at_ - begin);
    }

    // Parses the assignment of a value to a name.
    bool assignment() {
        blanks();
        const std::size_t begin = at_;
        const std::string_view word = name();
        if (word.empty() || !accept('=')) {
            at_ = begin;
            return false;
        }
        if (names_.contains(word) || is_function(word))
            fail_in_formula(begin, "\"" + std::string(word) + "\" is already defined");
        const Index value = sum();
        expect(';');
        names_.emplace(word, value);
        return true;
    }
    Index sum() {
        Index left = product();
        while (true) {
            blanks();
            const std::size_t offset = at_;
            if (accept('+')) {
                const Index right = product();
                steps_.stand_at(offset);
                left = steps_.add(left, right);
            } else if (accept('-')) {
                const Index right = product();
                steps_.stand_at(offset);
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
            const std::size_t offset = at_;
            if (accept('*')) {
                const Index right = with_sign();
                steps_.stand_at(offset);
                left = steps_.multiply(left, right);
            } else if (accept('/')) {
                const Index right = with_sign();
                steps_.stand_at(offset);
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
        const std::size_t offset = at_;
        const Index value = power();
        if (!is_negative) return value;
        steps_.stand_at(offset);
        return steps_.negate(value);
    }
    Index power() {
        const Index base = atom();
        blanks();
        const std::size_t offset = at_;
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
            fail_in_formula(at_, "an exponent must be a number" + found());
        const double exponent = sign * number();
        steps_.stand_at(offset);
        return steps_.power(base, exponent);
    }
    double number() {
        double value = 0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc()) fail_in_formula(at_, "this number cannot be read");
        steps_.stand_at(at_);
        at_ += static_cast<std::size_t>(end - begin);
        return value;
    }
    Index atom() {
        const Level level(*this);
        blanks();
        const std::size_t offset = at_;
        if (accept('(')) {
            const Index inner = sum();
            expect(')');
            return inner;
        }
        if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return steps_.constant(number());
        const std::string_view word = name();
        if (word.empty()) fail_in_formula(at_, "expected a number, a name or \"(\"" + found());
        if (accept('(')) return call(word, offset);
        if (const auto known = names_.find(word); known != names_.end()) return known->second;
        fail_in_formula(offset, is_function(word)
                                    ? "\"" + std::string(word) + "\" is a function and must be followed by (…)"
                                    : "unknown name \"" + std::string(word) + "\"; choose from " + all_names());
    }
    std::string all_names() const {
        std::string all;
        for (const auto& [word, index] : names_) all += (all.empty() ? "" : ", ") + std::string(word);
        return all;
    }

    static const FormulaFunction* function_of(std::string_view word) {
        const auto all = formula_functions();
        const auto found = std::ranges::find(all, word, &FormulaFunction::name);
        return found == all.end() ? nullptr : &*found;
    }
    static bool is_function(std::string_view word) { return function_of(word) != nullptr; }

    Index call(std::string_view word, std::size_t offset) {
        const FormulaFunction* const function = function_of(word);
        if (!function) {
            std::string all;
            for (const FormulaFunction& f : formula_functions()) all += (all.empty() ? "" : ", ") + std::string(f.name);
            fail_in_formula(offset, "unknown function \"" + std::string(word) + "\"; choose from " + all);
        }
        std::vector<Index> arguments;
        do arguments.push_back(sum());
        while (accept(','));
        expect(')');
        if (arguments.size() < function->least || arguments.size() > function->most)
            fail_in_formula(offset, "\"" + std::string(word) + "\" takes " + std::to_string(function->least) +
                                        (function->most == function->least ? ""
                                         : function->most > 100            ? " or more"
                                                                           : " to " + std::to_string(function->most)) +
                                        (function->most == 1 ? " argument" : " arguments") + ", but has " +
                                        std::to_string(arguments.size()));
        steps_.stand_at(offset);
        return function->apply(steps_, arguments);
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    FormulaSteps steps_;
    std::map<std::string_view, Index> names_;
};

}  // namespace

std::vector<FormulaStep> read_formula(const std::string& text) {
    return FormulaReader(text).read();
}

}  // namespace phasetree::nodes
