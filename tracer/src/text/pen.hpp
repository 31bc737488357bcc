// Converts a letter's path from a font to outlines of quadratic curves.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "phasetree/nodes/profiles/text_outlines.hpp"

namespace phasetree::tracer {

class Pen {
  public:
    // Points are scaled by `scale`, so that the em is 1, and then moved by `offset`.
    Pen(float scale, const glm::vec2& offset) : scale_(scale), offset_(offset) {}

    void move_to(const glm::vec2& p);
    void line_to(const glm::vec2& p);
    void quadratic_to(const glm::vec2& control, const glm::vec2& p);
    // Approximates a cubic curve by a few quadratic ones, with an error of at most a five-thousandth of the em.
    void cubic_to(const glm::vec2& control1, const glm::vec2& control2, const glm::vec2& p);
    void close();

    std::vector<TextOutlines::Contour> contours{};

  private:
    glm::dvec2 placed(const glm::vec2& p) const { return glm::dvec2(p) * static_cast<double>(scale_) + offset_; }
    void add(const glm::dvec2& control, const glm::dvec2& end);

    float scale_;
    glm::dvec2 offset_;
    glm::dvec2 at_{0.0};
    TextOutlines::Contour contour_{};  // ends at a point of the curve until it is closed
};

}  // namespace phasetree::tracer
