#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/nodes/node.hpp"

using namespace phasetree;

namespace {

/// One hidden layer with W = diag(a, b, c), and the sum of its outputs.
SirenNetwork diagonal(float a, float b, float c) {
    SirenNetwork n;
    n.layers = {{3, 3, {a, 0, 0, 0, b, 0, 0, 0, c}, {0, 0, 0}}, {3, 1, {1, 1, 1}, {-0.1f}}};
    return n;
}

Siren node_of(SirenNetwork network, int samples) {
    Siren n;
    n.file.content = std::make_shared<const SirenNetwork>(std::move(network));
    n.samples = samples;
    n.prepare();
    return n;
}

}  // namespace

TEST_CASE("the slope's bound is the product of the spectral norms, from above and close") {
    // ‖diag(1, 3, 2)‖ = 3, ‖(1 1 1)‖ = √3.
    const double bound = diagonal(1, 3, 2).spectral_bound(), exact = 3 * std::sqrt(3.0);
    CHECK(bound >= exact);
    CHECK(bound < exact * 1.001);
    // Far apart singular values too, where a plain power iteration is still below after few steps and a row sum above.
    SirenNetwork n = diagonal(1, 1, 1);
    n.layers[0].weights = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    CHECK(n.spectral_bound() == doctest::Approx(16.848103352614209 * std::sqrt(3.0)).epsilon(1e-3));
}

TEST_CASE("the sampled slope is what it says, and no bound is claimed for it") {
    // f = Σ sin(k x): the gradient (k cos(k x) …) is steepest at the origin, |k|·√3 there for equal k.
    const SirenNetwork n = diagonal(2, 2, 2);
    const double sampled = n.sampled_slope(20'000), steepest = 2 * std::sqrt(3.0);
    CHECK(sampled > 0.95 * 1.1 * steepest);
    CHECK(sampled <= 1.1 * steepest * 1.0001);
    CHECK(node_of(n, 20'000).lipschitz == doctest::Approx(sampled));
    CHECK(node_of(n, 0).lipschitz == doctest::Approx(n.spectral_bound()));
}

TEST_CASE("networks that do not fit together are refused") {
    const auto mistake = [](SirenNetwork n) { return std::string(n.mistake() ? n.mistake() : ""); };
    CHECK(mistake(diagonal(1, 1, 1)) == "");
    SirenNetwork n = diagonal(1, 1, 1);
    n.layers.pop_back();
    CHECK(mistake(n) == "the last layer must give one number, the distance");
    n = diagonal(1, 1, 1);
    n.layers[1].inputs = 2;
    CHECK(mistake(n) == "a layer takes another number of inputs than the one before gives");
    n = diagonal(1, 1, 1);
    n.layers[0].bias.pop_back();
    CHECK(mistake(n) == "a layer's weights and biases do not fit its inputs and outputs");
    n = diagonal(1e5f, 1, 1);
    CHECK(mistake(n) == "a layer's weights are too large");
    CHECK(mistake(SirenNetwork{}) == "the network has no layers");
}
