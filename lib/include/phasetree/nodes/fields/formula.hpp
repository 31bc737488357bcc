#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "phasetree/math/elementary.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

namespace formula {

/// The operations of a term, which is a part of a formula that is one primitive (see Formula). a, b and c are indices
/// of earlier values.
enum class Op : std::uint8_t {
    x,
    y,
    z,
    constant,         ///< the float stored instead of a
    negate,           ///< −a
    add,              ///< a + b
    subtract,         ///< a − b
    multiply,         ///< a b
    divide,           ///< a / b
    square,           ///< a²
    square_root,      ///< √a
    length_of_two,    ///< √(a² + b²)
    length_of_three,  ///< √(a² + b² + c²)
    minimum,          ///< min(a, b)
    maximum,          ///< max(a, b)
    absolute,         ///< |a|
    sine,             ///< sin a
    cosine,           ///< cos a
    exponential,      ///< eᵃ
    smooth_minimum,   ///< smooth_min(a, b, r), where r is the float stored instead of c
};

inline constexpr std::size_t max_operations = 128;
/// A term starts with two floats: the number of operations, and the factor 1/λ of the result.
inline constexpr std::size_t header = 2;
/// An operation is four floats: its Op, a, b and c.
inline constexpr std::size_t stride = 4;

template <class T>
T length_of(const T& a, const T& b) {
    return sqrt(a * a + b * b);
}

/// Compute all values of a term at p, in order.
template <class T>
void run(const float* data, const Vec3<T>& p, T* value) {
    const int count = static_cast<int>(data[0]);
    const float* at = data + header;
    for (int i = 0; i < count; ++i, at += stride) {
        const auto operand = [&](int k) -> const T& { return value[static_cast<std::size_t>(at[k])]; };
        T& to = value[i];
        switch (static_cast<Op>(static_cast<int>(at[0]))) {
            case Op::x:
                to = p.x;
                break;
            case Op::y:
                to = p.y;
                break;
            case Op::z:
                to = p.z;
                break;
            case Op::constant:
                to = T(at[1]);
                break;
            case Op::negate:
                to = -operand(1);
                break;
            case Op::add:
                to = operand(1) + operand(2);
                break;
            case Op::subtract:
                to = operand(1) - operand(2);
                break;
            case Op::multiply:
                to = operand(1) * operand(2);
                break;
            case Op::divide:
                to = operand(1) / operand(2);
                break;
            case Op::square:
                to = operand(1) * operand(1);
                break;
            case Op::square_root:
                to = sqrt(operand(1));
                break;
            case Op::length_of_two:
                to = length_of(operand(1), operand(2));
                break;
            case Op::length_of_three:
                to = length(Vec3<T>{operand(1), operand(2), operand(3)});
                break;
            case Op::minimum:
                to = min(operand(1), operand(2));
                break;
            case Op::maximum:
                to = max(operand(1), operand(2));
                break;
            case Op::absolute:
                to = abs(operand(1));
                break;
            case Op::sine:
                to = sine_of(operand(1));
                break;
            case Op::cosine:
                to = cosine_of(operand(1));
                break;
            case Op::exponential:
                to = exponential(operand(1));
                break;
            case Op::smooth_minimum:
                to = smooth_min(operand(1), operand(2), at[3]);
                break;
        }
    }
}

}  // namespace formula

/// The solid where a formula is negative.
///
/// Its minima, maxima, absolute values, negations and added constants become ordinary instructions, unless they are
/// inside other functions. The remaining sums, products and roots become primitives: terms. All are divided by λ, a
/// bound on the slope, computed with interval arithmetic.
///
/// The formula's author may give a box. B is then the box around the part of the solid inside it, and λ bounds the
/// slope only in B. Points outside are projected onto B, and the distance to B takes over where it is larger, as with
/// local warps (nodes/warps/warped.hpp).
struct Formula {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "formula", "", "f(x, y, z)/λ;  with bounds B: max(b(p), f(nearest point of B)/λ),  λ ≥ sup |∇f|",
        "The solid where a formula of x, y and z is negative. Formulas may use + − * / ^ with whole exponents, sqrt, "
        "abs, min, max, sin, cos, tan, exp, tanh, length, clamp, smooth_min, smooth_max, pi, and named values: \"r = "
        "sqrt(x^2 + y^2); r - 1\"."};

    /// A term f/λ.
    struct Term {
        static constexpr unsigned half_instructions = 120;
        static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
        std::vector<float> values{};

        std::span<const float> data() const { return values; }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            std::array<T, formula::max_operations> value;
            formula::run(data, p, value.data());
            return value[static_cast<std::size_t>(data[0]) - 1] * data[1];
        }
    };
    using Parts = TypeList<Term>;

    /// A term, or an operation on earlier parts. For a term, `a` is its index in `terms`; for an operation, `a` and `b`
    /// are indices in `parts`. `constant` is a summand or a radius.
    struct Part {
        enum class What : std::uint8_t { term, negate, absolute, minimum, maximum, add_constant, smooth_minimum };
        What what = What::term;
        std::uint32_t a = 0, b = 0;
        float constant = 0;
    };

    std::string text{};
    std::vector<glm::vec3> box{};  ///< the author's two corners, or empty
    // Everything below is derived.
    std::vector<Term> terms{};
    std::vector<Part> parts{};  ///< the last one is the formula
    BoundingBox bound{};        ///< B: around the part of the solid in the author's box; λ bounds the slope in it
    float lipschitz = 1;        ///< λ: the maximum bound over all terms; 1 if the formula is nearly constant

    template <class V>
    static void parameters(V&& v) {
        v(&Formula::text, Parameter{"text", "", "The formula."});
        v(&Formula::box, Parameter{"bounds", "m",
                                   "Lowest and highest corner of a box to which the solid is cut. Without it, the "
                                   "slope of the formula must be bounded everywhere.",
                                   limits::any, true});
    }
    /// Throws ModelError, with the position in the text, if the text is wrong or its slope is unbounded.
    void prepare();

    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        typename D::Point inside = p;
        if (!box.empty()) inside = d.map(ClampToBox{bound.centre - bound.half, bound.centre + bound.half}, p, 1.f);
        std::vector<typename D::Scalar> value;
        value.reserve(parts.size());
        for (const Part& part : parts) {
            const auto of = [&](std::uint32_t i) -> const typename D::Scalar& { return value[i]; };
            switch (part.what) {
                case Part::What::term:
                    value.push_back(d.primitive(terms[part.a], inside));
                    break;
                case Part::What::negate:
                    value.push_back(-of(part.a));
                    break;
                case Part::What::absolute:
                    value.push_back(abs(of(part.a)));
                    break;
                case Part::What::minimum:
                    value.push_back(min(of(part.a), of(part.b)));
                    break;
                case Part::What::maximum:
                    value.push_back(max(of(part.a), of(part.b)));
                    break;
                case Part::What::add_constant:
                    value.push_back(of(part.a) + part.constant);
                    break;
                case Part::What::smooth_minimum:
                    value.push_back(smooth_min(of(part.a), of(part.b), part.constant));
                    break;
            }
        }
        return box.empty() ? value.back() : max(d.primitive(bound, p), value.back());
    }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const {
        std::size_t sum = 0;
        for (const Term& term : terms) sum += sizeof term + term.data().size_bytes();
        return sum;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        if (box.empty()) return Bounds::everything();
        const glm::vec3 half = bound.half + level;
        if (half.x < 0 || half.y < 0 || half.z < 0) return {};
        return q.placed(Bounds{bound.centre - half, bound.centre + half});
    }
};

}  // namespace phasetree
