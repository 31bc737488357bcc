// One sum divided by another: a mean over the samples that have a value, such as the depth of the surface they met, or
// a weighted mean.
#pragma once

#include <array>
#include <cmath>

#include "film/sums/fixed_sum.hpp"

namespace phasetree::tracer {

/// A weighted mean of N values.
template <std::size_t N>
class WeightedMean {
  public:
    /// `weight` is from 0 to 1. The products of floats are exact in double precision. If any value is not finite, all
    /// are skipped, along with their weight.
    void add(const std::array<float, N>& values, float weight, FilmFaults& faults) {
        for (const float v : values)
            if (!std::isfinite(v)) {
                ++faults.not_finite;
                return;
            }
        for (std::size_t i = 0; i < N; ++i)
            sums_[i].add(static_cast<double>(weight) * static_cast<double>(values[i]), faults);
        weight_.add(static_cast<double>(weight), faults);
    }
    WeightedMean& operator+=(const WeightedMean& other) {
        for (std::size_t i = 0; i < N; ++i) sums_[i] += other.sums_[i];
        weight_ += other.weight_;
        return *this;
    }

    /// The sum of the weights. Divided by the number of samples, it is the share that had a value.
    double weight() const { return weight_.value(); }
    /// `otherwise` if the sum of the weights is 0.
    std::array<float, N> mean(float otherwise) const {
        std::array<float, N> means;
        const double weight = weight_.value();
        for (std::size_t i = 0; i < N; ++i)
            means[i] = weight > 0 ? static_cast<float>(sums_[i].value() / weight) : otherwise;
        return means;
    }

    bool operator==(const WeightedMean&) const = default;
    void write(ByteWriter& out) const {
        for (const ValueSum& sum : sums_) sum.write(out);
        weight_.write(out);
    }
    static WeightedMean read(ByteReader& in) {
        WeightedMean mean;
        for (ValueSum& sum : mean.sums_) sum = ValueSum::read(in);
        mean.weight_ = WeightSum::read(in);
        return mean;
    }

  private:
    std::array<ValueSum, N> sums_{};
    WeightSum weight_;
};

}  // namespace phasetree::tracer
