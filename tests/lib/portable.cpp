// The functions of phasetree/math/portable.hpp give the same bits everywhere, and nothing calls functions that do not.
#include "phasetree/math/portable.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <regex>

#include "phasetree/math/vec3.hpp"
#include "source_directory.hpp"
#include "support/rooms.hpp"
#include "support/uniform.hpp"

namespace test_portable {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// FNV-1a over the bits of f(u, v) at 100,000 points of [0, 1)².
template <class Function>
std::uint64_t bits_of(const Function& f) {
    Uniform uniform(17);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec2 p = uniform.two();
        const auto value = f(p.x, p.y);
        for (const auto byte : std::bit_cast<std::array<unsigned char, sizeof value>>(value))
            hash = (hash ^ byte) * 0x100000001b3u;
    }
    return hash;
}

// The names of mathematical functions whose results differ between processors, called or otherwise used. The list omits
// exactly rounded functions, and the five that agree according to portable.hpp.
const std::regex& not_portable() {
    static const std::string names =
        "(tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp2|exp10|expm1|log2|log10|log1p|cbrt|hypot|erf|"
        "erfc|"
        "tgamma|lgamma)";
    static const std::regex expression("\\b(std|glm)\\s*::\\s*" + names + "\\b|(^|[^\\w.:>])(::\\s*)?" + names +
                                       "[fl]?\\s*\\(|\\bstd::(complex|polar)\\b|#include <complex>");
    return expression;
}

// Whether a line of code uses one. Comments, and strings in other languages, do not count.
bool is_not_portable(const std::string& line) {
    static const std::regex text(R"("([^"\\]|\\.)*"|//.*)");
    return std::regex_search(std::regex_replace(line, text, ""), not_portable());
}

}  // namespace

TEST_CASE("functions of floats have the bits that they had on x86-64 and arm64") {
    CHECK(bits_of([](float u, float) { return portable::tan(3 * u - 1.5f); }) == 0x576371ceffc3402du);
    CHECK(bits_of([](float u, float) { return portable::asin(2 * u - 1); }) == 0xbc5c64f3db534e4au);
    CHECK(bits_of([](float u, float) { return portable::acos(2 * u - 1); }) == 0xd369406615bd09f1u);
    CHECK(bits_of([](float u, float v) { return portable::atan2(u - 0.5f, v - 0.5f); }) == 0x22de43a80122ae35u);
    CHECK(bits_of([](float u, float) { return portable::log1p(-u); }) == 0x585f024041553991u);
    CHECK(bits_of([](float u, float) { return portable::expm1(-8 * u); }) == 0x40f800340ffb02b7u);
    CHECK(bits_of([](float u, float) { return portable::exp2(60 * u - 40); }) == 0x3bf4f7c9f5240a1du);
    CHECK(bits_of([](float u, float v) { return portable::hypot(u, v); }) == 0x441797d8e8ffc29au);
    CHECK(bits_of([](float u, float v) { return portable::hypot(u, v, 0.5f); }) == 0xa669cf0c3705dfb2u);
    CHECK(bits_of([](float u, float) { return portable::cbrt(u); }) == 0xc167d675896a201fu);
}

TEST_CASE("functions of doubles that do not call the C library have these bits, too") {
    const auto wide = [](float a) { return static_cast<double>(a); };
    CHECK(bits_of([&](float u, float v) { return portable::hypot(wide(u), wide(v)); }) == 0x7caf14a05f8df3f9u);
    CHECK(bits_of([&](float u, float v) { return portable::hypot(wide(u), wide(v), 0.5); }) == 0xfa5960fa20bc6974u);
    CHECK(bits_of([&](float u, float v) { return portable::cbrt((wide(u) - 0.5) / wide(v + 0x1p-24f)); }) ==
          0x0c7cce43dd729afdu);
}

TEST_CASE("cube roots are within the stated error at any magnitude, and keep the sign") {
    Uniform uniform(3);
    double worst = 0;
    for (int exponent = -1022; exponent < 1024; ++exponent)
        for (int i = 0; i < 100; ++i) {
            // The root of a cube is known without another cbrt: c³ (1 + 3e) has the root c (1 + e), up to e².
            const double x = std::ldexp(0.5 + 0.5 * static_cast<double>(uniform()), exponent);
            const double root = portable::cbrt(x), product = root * root * root;
            const double low = std::fma(root * root, root, -product) + std::fma(root, root, -(root * root)) * root;
            worst = std::max(worst, std::abs(((product - x) + low) / x / 3));
            CHECK(portable::cbrt(-x) == -root);
        }
    MESSAGE("largest error: ", worst);
    CHECK(worst < 5e-16);
    CHECK(portable::cbrt(27.0) == 3);
    CHECK(portable::cbrt(0.0) == 0);
    CHECK(portable::cbrt(std::numeric_limits<double>::infinity()) == std::numeric_limits<double>::infinity());
    CHECK(std::isnan(portable::cbrt(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("hypot neither overflows nor underflows for floats") {
    constexpr float large = std::numeric_limits<float>::max() / 2, small = std::numeric_limits<float>::min();
    CHECK(portable::hypot(large, large) == doctest::Approx(std::sqrt(2.0) * static_cast<double>(large)));
    CHECK(portable::hypot(3 * small, 4 * small) == 5 * small);
    CHECK(portable::hypot(static_cast<double>(large) * 3, static_cast<double>(large) * 4) ==
          static_cast<double>(large) * 5);
}

TEST_CASE("nothing calls functions whose last bit depends on the processor") {
    for (const char* const use : {"std::tan(x)", "return hypot(x, y);", "glm::acos(c)", "x = -erff(y)", "::cbrt(v)",
                                  "using std::log1p;", "apply(std::atan2, x)", "std::complex<double> z"})
        CHECK_MESSAGE(is_not_portable(use), use);
    for (const char* const use : {"portable::tan(x)", "float tan = 0;", "v.hypot(x)", "Math.atan2(y, x)",
                                  "// std::tan(x)", "text += \"atan(x, y)\";", "std::exp(x)", "arctan(x)"})
        CHECK_MESSAGE(!is_not_portable(use), use);
    const std::set<std::string> kinds{".cpp", ".hpp", ".inl", ".c", ".h"};
    std::size_t files = 0;
    for (const char* const folder : {"lib/src", "lib/include", "tracer/src", "plugins"})
        for (const fs::path& file : files_below(fs::path(source_directory()) / folder)) {
            if (!kinds.contains(file.extension().string()) || file.filename() == "portable.hpp") continue;
            if (file.string().find("/plugins/embree/examples/") != std::string::npos) continue;
            ++files;
            const std::vector<std::string> lines = lines_of(file);
            for (std::size_t i = 0; i < lines.size(); ++i)
                if (is_not_portable(lines[i]))
                    FAIL_CHECK(file.string() << ":" << i + 1 << ": the last bit of this function depends on the "
                                             << "processor; use phasetree/math/portable.hpp instead:" << lines[i]);
        }
    CHECK(files > 500);
}

}  // namespace test_portable
