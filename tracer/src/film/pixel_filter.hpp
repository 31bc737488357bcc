// Pixel reconstruction filters, by filter importance sampling: a sample is displaced from the pixel's centre with the
// filter as its pdf, and every sample has the same weight (Ernst, Stamminger, Greiner: Filter Importance Sampling, IEEE
// Symposium on Interactive Ray Tracing 2006).
//
// Filters are separable. Along one axis, over x in [−r, r] pixels:
//     box              f = 1/(2r)
//     Blackman–Harris  f = (a₀ − a₁ cos 2πt + a₂ cos 4πt − a₃ cos 6πt)/(2r a₀),   t = (x + r)/(2r)
// with the four-term coefficients of Harris: On the Use of Windows for Harmonic Analysis with the Discrete Fourier
// Transform, Proc. IEEE 66(1), 1978. Both are non-negative and integrate to 1.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace phasetree::tracer {

class PixelFilter {
  public:
    enum class Shape { box, blackman_harris };

    /// Blackman–Harris with a radius of 1.5 pixels.
    PixelFilter() : PixelFilter(Shape::blackman_harris, 1.5f) {}
    PixelFilter(Shape shape, float radius);

    /// The displacement from the pixel's centre, in pixels, for u in [0, 1)².
    glm::vec2 sample(const glm::vec2& u) const { return {sample(u.x), sample(u.y)}; }
    float sample(float u) const;
    /// The pdf of either component of sample().
    float pdf(float x) const;

    Shape shape() const { return shape_; }
    float radius() const { return radius_; }

  private:
    Shape shape_;
    float radius_;
    std::vector<float> cumulative_;  ///< at equally spaced t, from 0 to 1; empty for the box
};

}  // namespace phasetree::tracer
