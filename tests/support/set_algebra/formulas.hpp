#pragma once

/// Formulas, computed from their text at each point: by recursion, in double, with the functions of the standard
/// library.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/set_algebra/primitives.hpp"

namespace phasetree::tests::oracle {

class FormulaAtPoint {
  public:
    FormulaAtPoint(const std::string& text, const dvec3& p)
        : at_(text.c_str()), names_{{"x", p.x}, {"y", p.y}, {"z", p.z}, {"pi", 3.14159265358979323846}} {}

    double compute() {
        while (true) {
            const char* const from = at_;
            const std::string word = name();
            if (word.empty() || !take('=')) {
                at_ = from;
                return sum();
            }
            names_[word] = sum();
            take(';');
        }
    }

  private:
    void blanks() {
        while (std::isspace(static_cast<unsigned char>(*at_))) ++at_;
    }
    bool take(char c) {
        blanks();
        if (*at_ != c) return false;
        ++at_;
        return true;
    }
    std::string name() {
        blanks();
        std::string word;
        while (std::isalpha(static_cast<unsigned char>(*at_)) || *at_ == '_') word += *at_++;
        return word;
    }
    double sum() {
        double v = product();
        while (true) {
            if (take('+'))
                v += product();
            else if (take('-'))
                v -= product();
            else
                return v;
        }
    }
    double product() {
        double v = power();
        while (true) {
            if (take('*'))
                v *= power();
            else if (take('/'))
                v /= power();
            else
                return v;
        }
    }
    double power() {
        if (take('-')) return -power();
        double v = atom();
        if (take('^')) v = std::pow(v, power());
        return v;
    }
    double atom() {
        if (take('(')) {
            const double v = sum();
            take(')');
            return v;
        }
        const std::string word = name();
        if (word.empty()) {
            char* end = nullptr;
            const double v = std::strtod(at_, &end);
            at_ = end;
            return v;
        }
        if (!take('(')) return names_.at(word);
        std::vector<double> a;
        do a.push_back(sum());
        while (take(','));
        take(')');
        return call(word, a);
    }
    static double call(const std::string& f, const std::vector<double>& a) {
        if (f == "sqrt") return std::sqrt(a[0]);
        if (f == "abs") return std::abs(a[0]);
        if (f == "sin") return std::sin(a[0]);
        if (f == "cos") return std::cos(a[0]);
        if (f == "tan") return std::tan(a[0]);
        if (f == "exp") return std::exp(a[0]);
        if (f == "tanh") return std::tanh(a[0]);
        if (f == "square") return a[0] * a[0];
        if (f == "pow") return std::pow(a[0], a[1]);
        if (f == "length") return a.size() == 2 ? std::hypot(a[0], a[1]) : std::hypot(a[0], a[1], a[2]);
        if (f == "clamp") return std::min(std::max(a[0], a[1]), a[2]);
        if (f == "min") return *std::min_element(a.begin(), a.end());
        if (f == "max") return *std::max_element(a.begin(), a.end());
        const double seam = std::pow(std::max(0.0, 1 - std::abs(a[0] - a[1]) / a[2]), 3) * a[2] / 6;
        if (f == "smooth_min") return std::min(a[0], a[1]) - seam;
        if (f == "smooth_max") return std::max(a[0], a[1]) + seam;
        throw std::logic_error("the oracle does not know " + f);
    }

    const char* at_;
    std::map<std::string, double> names_;
};

inline bool member(const Formula& n, const dvec3& p) {
    for (int i = 0; !n.box.empty() && i < 3; ++i)
        if (p[i] < static_cast<double>(n.box[0][i]) || p[i] > static_cast<double>(n.box[1][i])) return false;
    return FormulaAtPoint(n.text, p).compute() < 0;
}
/// λ and the box around the solid are taken from the node; other tests check them.
inline double signed_value(const Formula& n, const dvec3& p) {
    const double slope = n.lipschitz;
    if (n.box.empty()) return FormulaAtPoint(n.text, p).compute() / slope;
    const dvec3 centre(n.bound.centre), half(n.bound.half);
    const dvec3 inside = glm::clamp(p, centre - half, centre + half);
    return std::max(box(p - centre, half), FormulaAtPoint(n.text, inside).compute() / slope);
}

}  // namespace phasetree::tests::oracle
