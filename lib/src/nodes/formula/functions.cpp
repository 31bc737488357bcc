#include "nodes/formula/functions.hpp"

#include <array>
#include <cmath>

namespace phasetree::nodes {

using formula::Op;

std::span<const FormulaFunction> formula_functions() {
    using Values = const std::vector<FormulaIndex>&;
    static constexpr std::size_t any = 1000;
    static const std::array<FormulaFunction, 15> all{{
        {"sqrt", 1, 1, [](FormulaSteps& s, Values v) { return s.square_root(v[0]); }},
        {"abs", 1, 1, [](FormulaSteps& s, Values v) { return s.absolute(v[0]); }},
        {"min", 2, any,
         [](FormulaSteps& s, Values v) {
             FormulaIndex least = v[0];
             for (std::size_t i = 1; i < v.size(); ++i) least = s.minimum(least, v[i]);
             return least;
         }},
        {"max", 2, any,
         [](FormulaSteps& s, Values v) {
             FormulaIndex most = v[0];
             for (std::size_t i = 1; i < v.size(); ++i) most = s.maximum(most, v[i]);
             return most;
         }},
        {"sin", 1, 1, [](FormulaSteps& s, Values v) { return s.function(Op::sine, v[0], std::sin); }},
        {"cos", 1, 1, [](FormulaSteps& s, Values v) { return s.function(Op::cosine, v[0], std::cos); }},
        {"tan", 1, 1,
         [](FormulaSteps& s, Values v) {
             const FormulaIndex sine = s.function(Op::sine, v[0], std::sin);
             return s.divide(sine, s.function(Op::cosine, v[0], std::cos));
         }},
        {"exp", 1, 1, [](FormulaSteps& s, Values v) { return s.function(Op::exponential, v[0], std::exp); }},
        {"tanh", 1, 1,
         [](FormulaSteps& s, Values v) {  // 1 − 2/(e²ᵃ + 1)
             const FormulaIndex e = s.function(Op::exponential, s.multiply(s.constant(2), v[0]), std::exp);
             return s.subtract(s.constant(1), s.divide(s.constant(2), s.add(e, s.constant(1))));
         }},
        {"length", 2, 3,
         [](FormulaSteps& s, Values v) {
             return v.size() == 2 ? s.length_of(v[0], v[1]) : s.length_of(v[0], v[1], v[2]);
         }},
        {"clamp", 3, 3, [](FormulaSteps& s, Values v) { return s.minimum(s.maximum(v[0], v[1]), v[2]); }},
        {"smooth_min", 3, 3, [](FormulaSteps& s, Values v) { return s.smooth_minimum(v[0], v[1], v[2]); }},
        {"smooth_max", 3, 3,
         [](FormulaSteps& s, Values v) { return s.negate(s.smooth_minimum(s.negate(v[0]), s.negate(v[1]), v[2])); }},
        {"square", 1, 1, [](FormulaSteps& s, Values v) { return s.multiply(v[0], v[0]); }},
        {"pow", 2, 2, [](FormulaSteps& s, Values v) { return s.power_of(v[0], v[1]); }},
    }};
    return all;
}

}  // namespace phasetree::nodes
