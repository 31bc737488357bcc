// The sum of values and of their squares, which give the mean and its variance.
#pragma once

#include <algorithm>

#include "film/sums/fixed_sum.hpp"

namespace phasetree::tracer {

class MeanAndVariance {
  public:
    void add(float value, FilmFaults& faults) {
        const auto v = static_cast<double>(value);
        FilmFaults uncounted;  // the square has the same faults
        sum_.add(v, faults);
        squares_.add(v * v, uncounted);  // exact: at most 48 bits, twice the 24 of a float
    }
    MeanAndVariance& operator+=(const MeanAndVariance& other) {
        sum_ += other.sum_;
        squares_ += other.squares_;
        return *this;
    }

    double mean(std::uint32_t samples) const { return sum_.value() / samples; }
    /// The variance of the mean of this many independent samples, estimated from the samples themselves,
    ///     (Σv²/n − (Σv/n)²)/(n − 1),
    /// with an error of about 2^−51 of the mean's square; 0 for a single sample.
    double variance_of_mean(std::uint32_t samples) const {
        if (samples < 2) return 0;
        const double m = mean(samples), of_values = squares_.value() / samples - m * m;
        return std::max(of_values, 0.0) / (samples - 1);
    }

    bool operator==(const MeanAndVariance&) const = default;
    void write(ByteWriter& out) const {
        sum_.write(out);
        squares_.write(out);
    }
    static MeanAndVariance read(ByteReader& in) {
        MeanAndVariance both;
        both.sum_ = ValueSum::read(in);
        both.squares_ = SquareSum::read(in);
        return both;
    }

  private:
    ValueSum sum_;
    SquareSum squares_;
};

}  // namespace phasetree::tracer
