// The sums of which planes consist: exact compared with sums of digits, the same in any order and partition, and the
// same after writing and reading.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "film/contract.hpp"
#include "film/sums/count.hpp"
#include "film/sums/first_value.hpp"
#include "film/sums/mean_and_variance.hpp"
#include "film/sums/weighted_mean.hpp"
#include "film/sums/weights_by_id.hpp"

namespace test_film_sums {

using namespace phasetree::tracer;

namespace {

static_assert(SumKind<ValueSum> && SumKind<SquareSum> && SumKind<WeightSum> && SumKind<MeanAndVariance> &&
              SumKind<Count> && SumKind<WeightedMean<1>> && SumKind<WeightedMean<3>> && SumKind<FirstValue<2>> &&
              SumKind<WeightsById>);
static_assert(sizeof(ValueSum) == 16 && sizeof(SquareSum) == 24 && sizeof(WeightSum) == 8 &&
              sizeof(MeanAndVariance) == 40);
static_assert(ValueSum::limit_exponent == 40 && SquareSum::limit_exponent == 80 && WeightSum::limit_exponent == 1);

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

// A sum of multiples of 2^−fraction. Digits of 24 bits are summed separately and never carried.
class DigitSum {
  public:
    explicit DigitSum(int fraction) : fraction_(fraction) {}
    void add(double value) {
        double rest = std::nearbyint(std::ldexp(value, fraction_));  // ties to even
        for (std::size_t i = digits_.size(); i-- > 0;) {
            const double digit = std::trunc(std::ldexp(rest, -24 * static_cast<int>(i)));
            digits_[i] += static_cast<std::int64_t>(digit);
            rest -= std::ldexp(digit, 24 * static_cast<int>(i));
        }
    }
    // Whether a sum equals this one.
    template <class Sum>
    bool is(Sum sum) const {
        FilmFaults faults;
        for (std::size_t i = 0; i < digits_.size(); ++i) {
            // In two halves of at most 31 bits, each exact.
            const std::int64_t high = digits_[i] / (1 << 24), low = digits_[i] % (1 << 24);
            const int exponent = 24 * static_cast<int>(i) - fraction_;
            take_away(sum, std::ldexp(static_cast<double>(low), exponent), faults);
            take_away(sum, std::ldexp(static_cast<double>(high), exponent + 24), faults);
        }
        return sum == Sum{} && faults == FilmFaults{};
    }

  private:
    // A difference that is larger than a sum accepts at once is subtracted in halves.
    template <class Sum>
    static void take_away(Sum& sum, double value, FilmFaults& faults) {
        if (std::abs(value) < std::ldexp(1, Sum::limit_exponent)) return sum.add(-value, faults);
        for (int half = 0; half < 2; ++half) take_away(sum, value / 2, faults);
    }

    int fraction_;
    std::array<std::int64_t, 8> digits_{};
};

// Values of either sign, with magnitudes from below the unit to the limit.
double random_value(std::mt19937& random, int lowest_exponent, int limit_exponent) {
    const double mantissa = std::ldexp(static_cast<double>(random()) + 0x1p-32 * static_cast<double>(random()), -32);
    const int exponent = std::uniform_int_distribution(lowest_exponent, limit_exponent - 1)(random);
    return std::ldexp(random() % 2 ? 1 + mantissa : -1 - mantissa, exponent);
}

template <class Sum>
void check_exact(int fraction) {
    std::mt19937 random(7);
    for (int n = 0; n < 300; ++n) {
        Sum sum;
        DigitSum expected(fraction);
        FilmFaults faults;
        for (int i = 0; i < n; ++i) {
            const double value = random_value(random, -fraction - 3, Sum::limit_exponent);
            sum.add(value, faults);
            expected.add(value);
        }
        CHECK(expected.is(sum));
        CHECK(faults == FilmFaults{});
        // The comparison can fail.
        Sum more = sum;
        more.add(std::ldexp(1, -fraction), faults);
        CHECK_FALSE(expected.is(more));
    }
    // A single value is preserved, up to the unit.
    for (int i = 0; i < 2000; ++i) {
        const double value = random_value(random, -fraction - 3, Sum::limit_exponent);
        Sum sum;
        FilmFaults faults;
        sum.add(value, faults);
        CHECK(sum.value() == std::ldexp(std::nearbyint(std::ldexp(value, fraction)), -fraction));
    }
}

template <class Sum>
std::vector<std::byte> bytes_of(const Sum& sum) {
    ByteWriter out;
    sum.write(out);
    return out.bytes();
}

// Adds the values in a random order to a random number of sums, and joins these in a random order.
template <class Sum, class Values, class Add>
std::pair<Sum, FilmFaults> in_any_order(const Values& values, const Add& add, std::mt19937& random) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    std::vector<Sum> parts(1 + random() % 7);
    FilmFaults faults;
    for (const std::size_t i : order) add(parts[random() % parts.size()], values[i], i, faults);
    while (parts.size() > 1) {
        std::ranges::shuffle(parts, random);
        const Sum last = parts.back();
        parts.pop_back();
        parts.front() += last;
    }
    return {parts.front(), faults};
}

// Whether no order and no partition changes the sum.
template <class Sum, class Values, class Add>
bool is_independent(const Values& values, const Add& add) {
    std::mt19937 random(11);
    Sum sum{};
    FilmFaults faults;
    for (std::size_t i = 0; i < values.size(); ++i) add(sum, values[i], i, faults);
    for (int i = 0; i < 100; ++i) {
        const auto [other, other_faults] = in_any_order<Sum>(values, add, random);
        if (!(other == sum) || !(other_faults == faults)) return false;
        if constexpr (SumKind<Sum>) {
            const std::vector<std::byte> bytes = bytes_of(sum);
            if (bytes_of(other) != bytes) return false;
            ByteReader in(bytes);
            if (!(Sum::read(in) == sum) || in.bytes_left() != 0) return false;
            for (std::size_t n = 0; n < bytes.size(); ++n) {
                ByteReader cut(std::span<const std::byte>(bytes).first(n));
                CHECK_THROWS_AS(Sum::read(cut), BytesError);
            }
        }
    }
    return true;
}

// Possible inputs: of any magnitude, not finite, too large.
std::vector<float> hostile_values() {
    std::mt19937 random(3);
    std::vector<float> values{infinity, -infinity, no_number, 3e38f, -3e38f, 1e-45f, 0.0f, -0.0f, 1e10f};
    for (int i = 0; i < 200; ++i) values.push_back(static_cast<float>(random_value(random, -60, 44)));
    return values;
}

}  // namespace

TEST_CASE("a sum is exact, whatever is added to it") {
    check_exact<ValueSum>(56);
    check_exact<SquareSum>(80);
    check_exact<WeightSum>(31);
}

TEST_CASE("a sum's value is the nearest double, ties to even") {
    const auto value = [](auto sum, std::initializer_list<double> terms) {
        FilmFaults faults;
        for (const double term : terms) sum.add(term, faults);
        CHECK(faults == FilmFaults{});
        return sum.value();
    };
    for (const double sign : {1.0, -1.0}) {
        CHECK(value(ValueSum{}, {sign, sign * 0x1p-53}) == sign);
        CHECK(value(ValueSum{}, {sign, sign * 0x3p-53}) == sign * (1 + 0x1p-51));
        CHECK(value(ValueSum{}, {sign, sign * 0x1p-53, sign * 0x1p-56}) == sign * (1 + 0x1p-52));
        CHECK(value(ValueSum{}, {sign, sign * 0x1p-53, -sign * 0x1p-56}) == sign);
        CHECK(value(SquareSum{}, {sign * 0x1p70, sign * 0x1p17}) == sign * 0x1p70);
        CHECK(value(SquareSum{}, {sign * 0x1p70, sign * 0x1p17, sign * 0x1p-80}) == sign * (0x1p70 + 0x1p18));
        CHECK(value(SquareSum{}, {sign * 0x1p70, sign * 0x1p17, -sign * 0x1p-80}) == sign * 0x1p70);
    }
    CHECK(value(ValueSum{}, {}) == 0);
    CHECK(value(ValueSum{}, {0x1p39, -0x1p39}) == 0);
}

TEST_CASE("2^31 of the largest values do not overflow, and none of what is larger does") {
    for (const double sign : {1.0, -1.0}) {
        ValueSum sum;
        FilmFaults faults;
        sum.add(sign * 1e300, faults);
        CHECK(faults == FilmFaults{.too_large = 1});
        const double cut = sum.value();
        CHECK(cut == sign * 0x1p40);  // rounded: it is a unit less
        for (int i = 0; i < 31; ++i) sum += ValueSum(sum);
        CHECK(sum.value() == cut * 0x1p31);
        ValueSum limit, below;
        FilmFaults of_limit, of_below;
        limit.add(sign * 0x1p40, of_limit);
        below.add(sign * std::nextafter(0x1p40, 0), of_below);
        CHECK(of_limit.too_large == 1);
        CHECK(of_below == FilmFaults{});
        CHECK(std::abs(below.value()) < std::abs(limit.value()));
    }
}

TEST_CASE("no order and no partition changes any kind of sum") {
    const std::vector<float> values = hostile_values();
    const auto add = [](auto& sum, float v, std::size_t, FilmFaults& faults) {
        sum.add(static_cast<double>(v), faults);
    };
    CHECK(is_independent<ValueSum>(values, add));
    CHECK(is_independent<SquareSum>(values, add));
    CHECK(is_independent<WeightSum>(values, add));
    CHECK(is_independent<MeanAndVariance>(
        values, [](MeanAndVariance& m, float v, std::size_t, FilmFaults& f) { m.add(v, f); }));
    CHECK(is_independent<Count>(values, [](Count& c, float v, std::size_t, FilmFaults&) { c.count += v > 0; }));
    CHECK(is_independent<WeightedMean<2>>(values, [](auto& mean, float v, std::size_t i, FilmFaults& faults) {
        mean.add({v, 1.0f}, static_cast<float>(i % 5) / 4.0f, faults);
    }));
    CHECK(is_independent<FirstValue<2>>(values, [](auto& first, float v, std::size_t i, FilmFaults&) {
        if (i > 4) first.add({v, no_number}, static_cast<std::uint32_t>(i));
    }));
    CHECK(is_independent<WeightsById>(values, [](auto& weights, float, std::size_t i, FilmFaults& faults) {
        weights.add(static_cast<std::uint32_t>(i * i % 17), 1.0f / static_cast<float>(1 + i % 7), faults);
    }));

    // The test detects planes that a film must not have: floating-point sums, and the last value.
    std::vector<float> tame(200);
    for (std::size_t i = 0; i < tame.size(); ++i) tame[i] = 1.0f / static_cast<float>(i + 3);
    CHECK_FALSE(is_independent<double>(
        tame, [](double& s, float v, std::size_t, FilmFaults&) { s += static_cast<double>(v) * 0.1; }));
    CHECK_FALSE(is_independent<float>(tame, [](float& s, float v, std::size_t, FilmFaults&) { s = v; }));
}

TEST_CASE("moments: the variance of the mean, as long double has it") {
    std::mt19937 random(5);
    for (const float scale : {1e-6f, 1.0f, 1e10f}) {
        std::vector<float> values;
        for (int i = 0; i < 1000; ++i) values.push_back(scale * (2.0f + static_cast<float>(random()) * 0x1p-32f));
        MeanAndVariance moments;
        FilmFaults faults;
        long double sum = 0, deviations = 0;
        for (const float v : values) {
            moments.add(v, faults);
            sum += static_cast<long double>(v);
        }
        const long double mean = sum / 1000;
        for (const float v : values)
            deviations += (static_cast<long double>(v) - mean) * (static_cast<long double>(v) - mean);
        const auto expected = static_cast<double>(deviations / 1000 / 999);
        CHECK(moments.mean(1000) == doctest::Approx(static_cast<double>(mean)).epsilon(1e-15));
        CHECK(moments.variance_of_mean(1000) == doctest::Approx(expected).epsilon(1e-10));
    }
    MeanAndVariance one;
    FilmFaults faults;
    one.add(3, faults);
    CHECK(one.variance_of_mean(1) == 0);
}

TEST_CASE("means, choices and weights") {
    FilmFaults faults;
    WeightedMean<2> mean;
    CHECK(mean.mean(-1) == std::array{-1.0f, -1.0f});
    mean.add({2, 10}, 1, faults);
    mean.add({4, no_number}, 1, faults);  // left out
    mean.add({5, 40}, 0.5f, faults);
    CHECK(mean.mean(-1) == std::array{3.0f, 20.0f});
    CHECK(mean.weight() == 1.5);
    CHECK(faults == FilmFaults{.not_finite = 1});

    FirstValue<1> first;
    CHECK(first.values(7) == std::array{7.0f});
    first.add({5}, 9);
    first.add({6}, 2);
    first.add({8}, 3);
    CHECK(first.values(7) == std::array{6.0f});

    WeightsById weights;
    weights.add(9, 0.25f, faults);
    weights.add(4, 1, faults);
    weights.add(9, 0.5f, faults);
    REQUIRE(weights.entries().size() == 2);
    CHECK(weights.entries()[0].id == 4);
    CHECK(weights.entries()[1].weight.value() == 0.75);
}

TEST_CASE("bytes that no sum writes are rejected") {
    const auto read = []<class Sum>(Sum, std::vector<int> numbers) {
        std::vector<std::byte> bytes;
        for (const int n : numbers) bytes.push_back(static_cast<std::byte>(n));
        ByteReader in(bytes);
        return Sum::read(in);
    };
    CHECK_THROWS_AS(read(ValueSum{}, {255}), BytesError);      // 15 zeros
    CHECK_THROWS_AS(read(ValueSum{}, {16 + 17}), BytesError);  // 16 bytes above one zero
    CHECK_THROWS_AS(read(WeightsById{}, {255, 255, 255, 255, 1, 0, 0, 0}), BytesError);
    CHECK_THROWS_AS(read(WeightsById{}, {2, 0, 0, 0, 5, 0, 0, 0, 72, 5, 0, 0, 0, 72}), BytesError);
    CHECK(read(WeightsById{}, {2, 0, 0, 0, 4, 0, 0, 0, 72, 5, 0, 0, 0, 72}).entries().size() == 2);
}

}  // namespace test_film_sums
