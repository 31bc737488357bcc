#include "nodes/formula/terms.hpp"

namespace phasetree::nodes {

using formula::max_operations, formula::Op;
using Index = FormulaIndex;

namespace {

// Makes a term from a step and all the steps that it needs.
TermSteps term_of(const std::vector<FormulaStep>& all, Index root) {
    TermSteps term{{}, needed_steps(all, root)};
    if (term.steps.size() > max_operations)
        fail_in_formula(all[root].offset, "there are more than 128 operations between minima and maxima");
    term.data = {static_cast<float>(term.steps.size()), 1};
    for (const FormulaStep& s : term.steps) {
        const auto value = static_cast<float>(s.value);
        term.data.insert(term.data.end(),
                         {static_cast<float>(s.op), s.op == Op::constant ? value : static_cast<float>(s.a),
                          static_cast<float>(s.b), s.op == Op::smooth_minimum ? value : static_cast<float>(s.c)});
    }
    return term;
}

// Divides a formula into terms and the operations that join them.
class Division {
  public:
    explicit Division(const std::vector<FormulaStep>& steps) : steps_(steps), part_of_(steps.size(), none) {}

    FormulaTerms found;

    Index divide(Index i) {
        using What = Formula::Part::What;
        if (part_of_[i] != none) return part_of_[i];
        const FormulaStep& s = steps_[i];
        Formula::Part part;
        switch (s.op) {
            case Op::minimum:
                part = {What::minimum, divide(s.a), divide(s.b), 0};
                break;
            case Op::maximum:
                part = {What::maximum, divide(s.a), divide(s.b), 0};
                break;
            case Op::smooth_minimum:
                part = {What::smooth_minimum, divide(s.a), divide(s.b), static_cast<float>(s.value)};
                break;
            case Op::negate:
                part = {What::negate, divide(s.a), 0, 0};
                break;
            case Op::absolute:
                part = {What::absolute, divide(s.a), 0, 0};
                break;
            case Op::add:
                if (is_constant(s.b) && is_joined(s.a))
                    part = {What::add_constant, divide(s.a), 0, value(s.b)};
                else if (is_constant(s.a) && is_joined(s.b))
                    part = {What::add_constant, divide(s.b), 0, value(s.a)};
                else
                    part = term(i);
                break;
            case Op::subtract:
                part = is_constant(s.b) && is_joined(s.a)
                           ? Formula::Part{What::add_constant, divide(s.a), 0, -value(s.b)}
                           : term(i);
                break;
            default:
                part = term(i);
        }
        found.parts.push_back(part);
        return part_of_[i] = static_cast<Index>(found.parts.size() - 1);
    }

  private:
    static constexpr Index none = ~Index{0};

    bool is_constant(Index i) const { return steps_[i].op == Op::constant; }
    float value(Index i) const { return static_cast<float>(steps_[i].value); }
    // Whether a value consists of minima, maxima and absolute values, up to constants and signs.
    bool is_joined(Index i) const {
        const FormulaStep& s = steps_[i];
        switch (s.op) {
            case Op::minimum:
            case Op::maximum:
            case Op::smooth_minimum:
            case Op::absolute:
                return true;
            case Op::negate:
                return is_joined(s.a);
            case Op::add:
                return (is_constant(s.b) && is_joined(s.a)) || (is_constant(s.a) && is_joined(s.b));
            case Op::subtract:
                return is_constant(s.b) && is_joined(s.a);
            default:
                return false;
        }
    }
    Formula::Part term(Index i) {
        found.terms.push_back(term_of(steps_, i));
        return {Formula::Part::What::term, static_cast<Index>(found.terms.size() - 1), 0, 0};
    }

    const std::vector<FormulaStep>& steps_;
    std::vector<Index> part_of_;
};

}  // namespace

FormulaTerms divided_into_terms(const std::vector<FormulaStep>& steps) {
    Division division(steps);
    (void)division.divide(static_cast<Index>(steps.size() - 1));
    return std::move(division.found);
}

}  // namespace phasetree::nodes
