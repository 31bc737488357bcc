#include "command/metres.hpp"

#include <cmath>

namespace phasetree::tracer {

namespace {

void scale(Measured& m, double factor) {
    m = scaled(m, factor);
}

void convert(Body& body, double unit) {
    const double cubed = unit * unit * unit;
    scale(body.volume, cubed);
    scale(body.mass, cubed);
    for (Measured& m : body.centre) scale(m, unit);
    for (auto& row : body.inertia)
        for (Measured& m : row) scale(m, cubed * unit * unit);
}

}  // namespace

Measured scaled(const Measured& m, double factor) {
    // The rounding errors of the factor and of the product.
    constexpr double error = 2e-15;
    return {factor * m.low - error * std::abs(factor * m.low), factor * m.high + error * std::abs(factor * m.high),
            factor * m.estimate};
}

void convert_to_metres(MeasureResult& measures, AreaResult& areas, const LengthUnit& unit) {
    if (unit.metres == 1) return;
    for (MeasuredPhase& p : measures.phases) {
        convert(p.body, unit.metres);
        for (Measured& m : p.box_low) scale(m, unit.metres);
        for (Measured& m : p.box_high) scale(m, unit.metres);
    }
    if (measures.all) convert(*measures.all, unit.metres);
    const double squared = unit.metres * unit.metres;
    const auto convert_area = [&](EstimatedArea& a) {
        a.area *= squared;
        a.standard_error *= squared;
    };
    for (AreaResult::OfPhase& a : areas.phases) convert_area(a);
    for (AreaResult::OfContact& a : areas.contacts) convert_area(a);
}

}  // namespace phasetree::tracer
