#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/siren.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "source_directory.hpp"

namespace test_siren {

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

TEST_CASE("networks that do not fit together are rejected") {
    const auto mistake = [](SirenNetwork n) { return std::string(n.mistake() ? n.mistake() : ""); };
    CHECK(mistake(diagonal(1, 1, 1)) == "");
    SirenNetwork n = diagonal(1, 1, 1);
    n.layers.pop_back();
    CHECK(mistake(n) == "the last layer must have one output, the distance");
    n = diagonal(1, 1, 1);
    n.layers[1].inputs = 2;
    CHECK(mistake(n) == "the number of inputs of a layer differs from the number of outputs of the one before");
    n = diagonal(1, 1, 1);
    n.layers[0].bias.pop_back();
    CHECK(mistake(n) == "the weights and biases of a layer do not match its inputs and outputs");
    n = diagonal(1e5f, 1, 1);
    CHECK(mistake(n) == "a layer's weights are too large");
    CHECK(mistake(SirenNetwork{}) == "the network has no layers");
}

TEST_CASE("the bunny is what its training said") {
    const Siren bunny = node_of(read_siren(source_directory() + "/scenes/assets/bunny.siren.json"), 0);
    CHECK(bunny.lipschitz == doctest::Approx(6.316).epsilon(2e-3));
    const double sampled = bunny.file.content->sampled_slope(20'000) / 1.1;
    CHECK(sampled > 1.1);
    CHECK(sampled < 1.3);
    const Field field = bunny;
    // The middle of the body, and points of the air around it: above the back, in front of the feet, between the ears
    // and the back.
    CHECK(distance(field, {0.1f, 0, -0.3f}) < 0);
    CHECK(distance(field, {0.5f, 0, 0.4f}) > 0);
    CHECK(distance(field, {-0.7f, -0.4f, -0.6f}) > 0);
    CHECK(distance(field, {0, 0, 0.95f}) > 0);
    // Its volume, by a grid, is that of the scan in its scale.
    int inside = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j)
            for (int k = 0; k < 64; ++k) {
                const auto at = [](int n) { return (static_cast<float>(n) + 0.5f) / 32 - 1; };
                inside += distance(field, {at(i), at(j), at(k)}) < 0;
            }
    CHECK(inside / 32768.0 == doctest::Approx(0.6309).epsilon(0.02));
}

TEST_CASE("a file of weights that is wrong says where") {
    CHECK_THROWS_AS((void)read_siren("/nonexistent/weights.json"), SceneError);
}

}  // namespace test_siren
