// Phase functions in scene files: what is read, and what is rejected, with its place and a remedy.
#include <doctest/doctest.h>

#include <string>

#include "media/medium.hpp"
#include "phasetree/io/error.hpp"
#include "tracer/support/paths.hpp"
#include "tracer/support/phase_function_equations.hpp"

namespace test_phase_functions_of_scenes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::draine_density;

namespace {

Scene scene_with(const std::string& members) {
    return scene_of(R"("fog": {"clear": {"ior": 1, )" + members + "}}",
                    R"({"set": {"phase": "fog", "of": {"sphere": {"radius": 1}}}})");
}

const HomogeneousMedium& medium_of(const Scene& scene) {
    return std::get<HomogeneousMedium>(std::get<Clear>(scene.materials[1]).interior);
}

std::string error_of(const std::string& members) {
    try {
        (void)scene_with(members);
    } catch (const phasetree::SceneError& e) {
        return e.what();
    }
    return "no error";
}

std::string function(const std::string& text) {
    return R"("scattering": [1, 1, 1], "phase_function": )" + text;
}

// Nested that many times: {"mix": {"first": {"rayleigh": {}}, "second": {"mix": …}}}.
std::string nested(int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += R"({"mix": {"first": {"rayleigh": {}}, "second": )";
    text += R"({"rayleigh": {}})";
    for (int i = 0; i < levels; ++i) text += "}}";
    return text;
}

}  // namespace

TEST_CASE("an anisotropy is Henyey and Greenstein's phase function, bit for bit") {
    const Scene by_anisotropy = scene_with(R"("scattering": [1, 1, 1], "anisotropy": 0.7)");
    const Scene by_name = scene_with(function(R"({"henyey_greenstein": {"g": 0.7}})"));
    const Scene neither = scene_with(R"("scattering": [1, 1, 1])"),
                isotropic = scene_with(function(R"({"henyey_greenstein": {}})"));
    for (const float mu : {-1.0f, -0.3f, 0.2f, 0.99f, 1.0f}) {
        const auto value = [&](const Scene& scene) { return medium_of(scene).phase_function().evaluate(mu); };
        CHECK(value(by_anisotropy) == value(by_name));
        CHECK(value(by_anisotropy) == HenyeyGreenstein(0.7f).evaluate(mu));
        CHECK(value(neither) == value(isotropic));
    }
}

TEST_CASE("measured media keep their reduced scattering for any phase function") {
    const auto reduced = [](const std::string& how) {
        const Scene scene = scene_with(R"("medium": "whole_milk", "scale": 1)" + how);
        const ScatteringCoefficients& c = medium_of(scene).coefficients();
        return c.scattering.x * (1 - c.phase_function.mean_cosine());
    };
    const float isotropic = reduced("");
    CHECK(reduced(R"(, "anisotropy": 0.8)") == doctest::Approx(isotropic).epsilon(1e-5));
    CHECK(reduced(R"(, "phase_function": {"droplets": {}})") == doctest::Approx(isotropic).epsilon(1e-5));
    CHECK(reduced(R"(, "phase_function": {"draine": {"g": 0.99, "alpha": 1000}})") ==
          doctest::Approx(isotropic).epsilon(1e-4));
}

TEST_CASE("mixes may be nested, as deep as any part of a file") {
    const Scene deep = scene_with(function(nested(300)));
    CHECK(static_cast<double>(medium_of(deep).phase_function().evaluate(0.3f)) ==
          doctest::Approx(draine_density(0, 1, 0.3)).epsilon(1e-4));
    CHECK(glm::length(medium_of(deep).phase_function().sample({0.7f, 0.2f})) == doctest::Approx(1).epsilon(1e-5));
    CHECK(error_of(function(nested(2000))).find("nested") != std::string::npos);
}

TEST_CASE("wrong phase functions are rejected where they stand, with a remedy") {
    const auto is_said = [](const std::string& members, const std::string& what) {
        const std::string said = error_of(members);
        CAPTURE(said);
        CHECK(said.find(what) != std::string::npos);
        CHECK(said.starts_with("test.json:1:"));
    };
    is_said(function(R"({"rayleigh": {}}, "anisotropy": 0.5)"),
            "\"phase_function\" and \"anisotropy\" cannot be combined; remove one of them");
    is_said(R"("absorption": [1, 1, 1], "phase_function": {"rayleigh": {}})",
            "\"phase_function\" requires \"scattering\"");
    is_said(function(R"({"droplets": {"diameter": 4.9}})"), "\"diameter\"");
    is_said(function(R"({"droplets": {"diameter": 51}})"), "50");
    is_said(function(R"({"droplets": {"diameter": NaN}})"), "NaN");
    is_said(function(R"({"droplets": {"diameter": 1e999}})"), "1e999");
    is_said(function(R"({"henyey_greenstein": {"g": 1}})"), "0.99");
    is_said(function(R"({"draine": {"alpha": -1}})"), "\"alpha\"");
    is_said(function(R"({"mix": {"first": {"rayleigh": {}}, "second": {"rayleigh": {}}, "amount": 1.01}})"),
            "\"amount\"");
    is_said(function(R"({"mix": {"first": {"rayleigh": {}}, "second": {"rayleigh": {}}, "amount": -0.1}})"),
            "\"amount\"");
    is_said(function(R"({"mix": {"first": {"rayleigh": {}}}})"), "\"second\"");
    is_said(function(R"({"mix": {"first": {"rayleigh": {}}, "second": 0.5}})"), "phase function");
    is_said(function(R"({"mie": {}})"), "cannot be of the kind \"mie\"");
    is_said(function(R"({"raylegh": {}})"), "did you mean \"rayleigh\"?");
    is_said(function(R"({"rayleigh": {"g": 0.5}})"), "unknown key \"g\"");
    is_said(function(R"({"rayleigh": {}, "droplets": {}})"), "phase function");
    is_said(function("0.5"), "phase function");
    is_said(function("[]"), "phase function");
}

}  // namespace test_phase_functions_of_scenes
