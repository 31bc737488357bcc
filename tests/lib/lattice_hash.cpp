// The lattice's hash in floats equals that in whole numbers, everywhere it may be asked, fused or not.
#include "phasetree/math/lattice_hash.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace test_lattice_hash {

using namespace phasetree;

namespace {

/// A float whose multiply_add rounds once, as processors with such an instruction do it.
struct Fused {
    float v;

    explicit Fused(float value) : v(value) {}
    friend Fused operator*(Fused a, Fused b) { return Fused(a.v * b.v); }
    friend Fused floor(Fused a) { return Fused(std::floor(a.v)); }
    friend Fused multiply_add(Fused a, float b, Fused c) { return Fused(std::fma(a.v, b, c.v)); }
};

long modulo_289(long n) {
    return ((n % 289) + 289) % 289;
}
long nearest_to_zero(long n) {
    const long m = modulo_289(n);
    return m > 144 ? m - 289 : m;
}

}  // namespace

TEST_CASE("numbers modulo 289 are those nearest to zero, below 2^22") {
    long wrong = 0;
    for (long n = -(1 << 22); n <= 1 << 22; ++n) {
        const auto f = static_cast<float>(n), expected = static_cast<float>(nearest_to_zero(n));
        wrong += lattice::wrapped(f) == expected && lattice::wrapped(Fused(f)).v == expected ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("hashes, of all sums of two numbers and up to 2, and of a hash and up to 3") {
    for (long n = -291; n <= 291; ++n) {
        CAPTURE(n);
        const auto f = static_cast<float>(n);
        const long hash = modulo_289((34 * n + 5) * n);
        CHECK(lattice::hashed(f) == static_cast<float>(hash));
        CHECK(lattice::hashed(Fused(f)).v == static_cast<float>(hash));
        CHECK(lattice::hashed_on(f) == static_cast<float>(nearest_to_zero(hash)));
        CHECK(lattice::hashed_on(Fused(f)).v == static_cast<float>(nearest_to_zero(hash)));
    }
}

}  // namespace test_lattice_hash
