// Formulas: the meaning of their text, the limits on their slopes, and what is rejected at which position in the text.
#include "phasetree/nodes/fields/formula.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "model/text_error.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"

namespace test_formula {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Formula prepared(std::string text, std::vector<glm::vec3> bounds = {}) {
    Formula f{.text = std::move(text), .box = std::move(bounds)};
    f.prepare();
    return f;
}
const std::vector<glm::vec3> cube{glm::vec3(-1.5f), glm::vec3(1.5f)};

// Evaluates terms alone.
struct Terms {
    using Scalar = float;
    using Point = Vec3<float>;
    template <class P>
    float primitive(const P& term, const Point& p) const {
        if constexpr (DataPrimitive<P>)
            return P::distance(term.data().data(), p);
        else
            return term.distance(p);
    }
    template <class M>
    Point map(const M& m, const Point& p, float) const {
        return m(p);
    }
};
// The formula's own value, without the box.
float at(Formula f, const glm::vec3& p) {
    const Terms terms;
    f.box.clear();
    return f.evaluate(terms, Vec3<float>{p.x, p.y, p.z}) * f.lipschitz;
}

TextError error_of(const std::string& text, std::vector<glm::vec3> bounds = {}) {
    try {
        (void)prepared(text, std::move(bounds));
    } catch (const TextError& e) {
        return e;
    }
    FAIL("accepted: " << text);
    throw std::logic_error("unreachable");
}
void check_refused(const std::string& text, std::size_t offset, const std::string& part,
                   std::vector<glm::vec3> bounds = {}) {
    CAPTURE(text);
    const TextError e = error_of(text, std::move(bounds));
    CHECK(e.offset() == offset);
    CAPTURE(e.message());
    CHECK(e.message().find(part) != std::string::npos);
    CHECK(e.parameter() == "text");
}

}  // namespace

TEST_CASE("operators bind as in textbooks") {
    const glm::vec3 p(0.5f, 0.25f, 0.125f);
    const auto value = [&](const std::string& text) { return at(prepared(text, cube), p); };
    CHECK(value("x - y - z") == doctest::Approx(0.125));
    CHECK(value("x - 2 * y * z") == doctest::Approx(0.4375));
    CHECK(value("-x^2") == doctest::Approx(-0.25));
    CHECK(value("x / 2 / (y + 2)") == doctest::Approx(1.0 / 9));
    CHECK(value("--x + +y") == doctest::Approx(0.75));
    CHECK(value("(x + y) * z") == doctest::Approx(0.09375));
    CHECK(value("a = x + y; b = a * a; b - a") == doctest::Approx(-0.1875));
    CHECK(value("1e-1 + .5 + 2.") == doctest::Approx(2.6));
    CHECK(value("(x + 2)^-2 * z^0") == doctest::Approx(0.16));
    CHECK(value("max(x, y, z) - min(x, y, z) + clamp(x, 0, 0.1)") == doctest::Approx(0.475));
    CHECK(value("sin(pi * x) + cos(pi * y) + tan(z)") == doctest::Approx(1.83276));
    CHECK(value("exp(x) + tanh(y)") == doctest::Approx(1.89364));
    CHECK(value("length(x, y) + length(x, y, z)") == doctest::Approx(1.13184));
}

TEST_CASE("slopes are found: of distances the least bound that there is") {
    CHECK(prepared("sqrt(x^2 + y^2) - 1").lipschitz == doctest::Approx(1));
    CHECK(prepared("sqrt((sqrt(x^2 + y^2) - 1)^2 + z^2) - 0.3").lipschitz == doctest::Approx(1));
    CHECK(prepared("max(abs(x) - 1, abs(y) - 1, abs(z) - 1)").lipschitz == doctest::Approx(1));
    CHECK(prepared("sqrt(4 * x^2 + y^2) - 1").lipschitz == doctest::Approx(2));
    CHECK(prepared("3 * x + 4 * y").lipschitz == doctest::Approx(5));
    // Of a length whose operands rise together: √2, and the largest singular value of the rows (1, 0) and (1, 1).
    CHECK(prepared("length(x, x)").lipschitz == doctest::Approx(std::sqrt(2.0)).epsilon(0.03));
    CHECK(prepared("length(x, x + y)").lipschitz >= 1.618f);
    // Over the box of the ball itself, not over the whole box.
    const Formula ball = prepared("x^2 + y^2 + z^2 - 1", cube);
    CHECK(ball.lipschitz < 4);
    CHECK(ball.bound.half.x < 1.2f);
    CHECK(prepared("7").lipschitz == 1);
}

TEST_CASE("formulas are 1-Lipschitz, also beyond their bounds") {
    Random rng(91);
    for (const char* text :
         {"x^2 + y^2 + z^2 - 1", "sin(4*x)*cos(4*y) + sin(4*y)*cos(4*z) + sin(4*z)*cos(4*x)",
          "(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3", "r = length(x, y); exp(-4 * r^2) - 0.3 + z^2",
          "z - tanh(3 * x) * y", "1 / (x^2 + 0.5) - 1 + abs(y * z)", "length(x, x + 0.1 * y, x - z) - 0.5"}) {
        CAPTURE(text);
        const Field f = prepared(text, cube);
        for (int n = 0; n < 20'000; ++n) {
            const glm::vec3 a = rng.in(Bounds::centred(glm::vec3(2.5f)));
            const glm::vec3 b = a + rng.uniform(0.001f, 0.3f) * rng.direction();
            const float apart = glm::length(a - b);
            REQUIRE(std::abs(distance(f, a) - distance(f, b)) <= apart * 1.0001f + 2e-6f);
        }
    }
}

TEST_CASE("minima, maxima and absolute values are instructions, and equal terms are one") {
    const auto instructions = [](const std::string& text) { return record(Field(prepared(text))).instructions.size(); };
    CHECK(instructions("min(length(x, y) - 1, length(y, z) - 1)") - instructions("length(x, y) - 1") == 2);
    CHECK(instructions("min(length(x, y) - 1, length(x, y) - 1)") == instructions("length(x, y) - 1"));
}

TEST_CASE("what is rejected, and where") {
    check_refused("x + ", 4, "expected a number, a name or \"(\", but the text ends");
    check_refused("x + q", 4, "unknown name \"q\"");
    check_refused("sin x", 0, "is a function");
    check_refused("x * foo(y)", 4, "unknown function \"foo\"; choose from sqrt");
    check_refused("min(x)", 0, "takes 2 or more arguments, but has 1");
    check_refused("length(x, y, z, x)", 0, "takes 2 to 3 arguments, but has 4");
    check_refused("(x + y", 6, "\")\" is expected here, but the text ends");
    check_refused("x^y", 2, "an exponent must be a number");
    check_refused("2 * x^2^1", 7, "expected an operator or the end");
    check_refused("x^0.3", 1, "a whole number from -64 to 64, or 0.5");
    check_refused("x = 3; x", 0, "is already defined");
    check_refused("r = x y", 6, "\";\" is expected here, but there is \"y\"");
    check_refused("2x", 1, "expected an operator or the end, but there is \"x\"");
    check_refused("", 0, "expected a number, a name or \"(\", but the text ends");
    check_refused("1e400", 0, "cannot be read");
    check_refused("x / 0", 2, "divides by zero");
    check_refused("sqrt(-1)", 0, "the argument of this root is negative");
    check_refused("x * \xc3\xa4", 4, "expected a number, a name or \"(\"");
    check_refused(std::string(20'001, ' '), 20'000, "longer than 20000 characters");
    check_refused(std::string(200, '(') + "x" + std::string(200, ')'), 100, "more than 100 levels deep");
    check_refused("smooth_min(x, y, z)", 0, "must be a positive number");
}

TEST_CASE("an exponent that is no number is rejected where the call stands") {
    check_refused("z + pow(x, y)", 4, "an exponent must be a number");
}

TEST_CASE("a slope without bound is rejected, and what it is that has none") {
    check_refused("x^2 + y^2 + z^2 - 1", 16, "unbounded far from the origin");
    check_refused("sin(x)", 0, "unbounded far from the origin");
    check_refused("y + 1 / x", 6, "divides by zero near (", cube);
    check_refused("y + sqrt(x)", 4, "is zero or negative near (", cube);
    check_refused("z - tan(3 * x)", 4, "divides by zero near", cube);
    check_refused("1e7 * x", 0, "too steep", cube);
    std::string sum = "x";
    for (int i = 0; i < 200; ++i) sum += " + " + std::to_string(i + 2) + " * sin(" + std::to_string(i) + " * y)";
    CHECK(error_of(sum, cube).message().find("more than 128 operations") != std::string::npos);
}

TEST_CASE("a text that means much is rejected before it is done") {
    std::string doubled = "a0 = x^2 + 1; ";
    for (int i = 1; i < 60; ++i)
        doubled += "a" + std::to_string(i) + " = a" + std::to_string(i - 1) + " + a" + std::to_string(i - 1) + "; ";
    CHECK_THROWS_AS((void)prepared(doubled + "sqrt(a59) - 1", cube), ModelError);
    std::string many = "sin(x)";
    for (int i = 0; i < 600; ++i) many = "max(" + many + ", 1 / (2 + sin(" + std::to_string(i) + " * x * y * z)))";
    CHECK_THROWS_AS((void)prepared(many, cube), ModelError);  // nested too deep
    many = "a = sin(x); ";
    for (int i = 0; i < 400; ++i)
        many += "b" + std::to_string(i) + " = max(" + (i ? "b" + std::to_string(i - 1) : "a") + ", 1 / (x^2 + " +
                std::to_string(i) + "e-7)); ";
    CHECK_THROWS_AS((void)prepared(many + "b399", cube), ModelError);  // too long to prepare, or too steep
}

TEST_CASE("bounds that are none are rejected") {
    const glm::vec3 low(-1), high(1);
    for (const std::vector<glm::vec3>& bounds : {std::vector{low}, std::vector{high, low}, std::vector{low, low},
                                                 std::vector{low, high, high}, std::vector{low, glm::vec3(1e7f)}})
        CHECK_THROWS_AS((void)prepared("x", bounds), ModelError);
}

TEST_CASE("e to the power of x is exact to a few units in the last place") {
    for (float x = -79.9f; x < 79.9f; x += 0.0137f) {
        const double exact = std::exp(static_cast<double>(x));
        REQUIRE(std::abs(exponential(x) - exact) <= 3 * 6e-8 * exact);
    }
    CHECK(exponential(0.f) == 1);
    CHECK(exponential(-1000.f) == exponential(-80.f));
    CHECK(power_of_two(-116.f) == std::ldexp(1.f, -116));
    for (int k = -116; k <= 116; ++k) CHECK(power_of_two(static_cast<float>(k)) == std::ldexp(1.f, k));
}

}  // namespace test_formula
