#pragma once

#include "building/worker_pool.hpp"
#include "evaluation/values_at_point.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::building {

/// Evaluates a program with its specialisations at one to eight points, one per lane. The result reads lane 0, which
/// holds the values at the first point; other lanes hold those at the other points. Its memory is in the worker's
/// scratch arena.
evaluation::ValuesAtPoint values_at_points(const rewriting::WorkingProgram&, std::span<const rewriting::Specialisation>,
                                           std::span<const glm::vec3> points, Worker&);

}  // namespace phasetree::building
