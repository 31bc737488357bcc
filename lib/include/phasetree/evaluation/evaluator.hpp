#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "phasetree/program/batch.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree {

/// A program made ready to run: registers assigned, operations resolved. Immutable; any thread may run it, each with
/// its own Workspace.
class Evaluator {
  public:
    explicit Evaluator(Program program);

    /// Scratch of one thread; grows to the largest evaluator it serves.
    class Workspace {
      public:
        float* registers(std::size_t slots) {
            if (values_.size() < slots) values_.resize(slots);
            return values_.data()->lane.data();
        }

      private:
        std::vector<BatchOfFloats> values_;
    };

    /// Φ at the points of a batch; out has a batch for each of program().outputs, in their order.
    void evaluate(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, std::span<BatchOfFloats> out,
                  Workspace&) const;
    /// Phase and interface distance at the points of a batch.
    void sample(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, Samples& out, Workspace&) const;
    /// The same along a ray, at origin + t·direction (a multiplication, then an addition, each rounded).
    void sample_ray(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t, Samples& out,
                    Workspace&) const;

    /// Φ at one point. Present phases only.
    Phases<float> distances(const glm::vec3& p, Workspace&) const;
    Phase label(const glm::vec3& p, Workspace&) const;

    /// Gradient of one component at p, zero if the phase is absent: by dual numbers, exact up to rounding; not
    /// normalised (a warp divides by λ).
    glm::vec3 gradient(const glm::vec3& p, Phase) const;

    const Program& program() const { return program_; }
    std::size_t bytes() const;

    /// The scratch of one thread that all tracing shares.
    static Workspace& thread_workspace();

  private:
    friend class InterfaceTracer;
    Program program_;
    std::shared_ptr<const struct Assembly> assembly_;
};

/// The SIMD instruction sets that this build and this machine share, best first: "AVX-512", "AVX2", "SSE4", "SSE2".
std::vector<std::string> simd_targets();
/// The one in use.
std::string simd_target();
/// Uses another one of simd_targets(), for tests and benchmarks; results do not change. Not while evaluators run.
/// Throws std::invalid_argument for a name that is not among them.
void use_simd_target(std::string_view name);

}  // namespace phasetree
