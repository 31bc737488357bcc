#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "phasetree/program/batch.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree {

namespace evaluation {
struct Assembly;
}

/// An executable program: each value has a register, and each operation is bound to the function that runs it.
/// Immutable; any thread may run it, each with its own Workspace.
class Evaluator {
  public:
    explicit Evaluator(Program program);

    /// The registers of one thread. They grow to fit the largest evaluator that uses them.
    class Workspace {
      public:
        float* registers(std::size_t slots) {
            if (values_.size() < slots) values_.resize(slots);
            return values_.data()->lane.data();
        }

      private:
        std::vector<BatchOfFloats> values_;
    };

    /// Evaluate Φ, the object's distances (see Phases), at the points of a batch. `out` must have one batch per entry
    /// of program().outputs, and receives their values in the same order.
    void evaluate(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, std::span<BatchOfFloats> out,
                  Workspace&) const;
    /// Evaluate the phase and the interface distance (see Samples) at the points of a batch.
    void sample(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, Samples& out, Workspace&) const;
    /// The same at the points origin + t·direction of a ray (a multiplication and an addition, each rounded).
    void sample_ray(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t, Samples& out,
                    Workspace&) const;

    /// Φ at one point. It has the phases that are present in the object.
    Phases<float> distances(const glm::vec3& p, Workspace&) const;
    /// The phase at one point.
    Phase label(const glm::vec3& p, Workspace&) const;

    /// The gradient of one component at p, exact up to rounding (by dual numbers); zero if the phase is absent. It may
    /// be shorter than 1, because a warp divides distances by an upper bound on how much its map stretches space.
    glm::vec3 gradient(const glm::vec3& p, Phase) const;

    const Program& program() const { return program_; }
    std::size_t bytes() const;

    /// The calling thread's workspace. All tracing in this thread may share it.
    static Workspace& thread_workspace();

  private:
    friend class InterfaceTracer;
    Program program_;
    std::shared_ptr<const evaluation::Assembly> assembly_;
};

/// The SIMD instruction sets supported by both this build and this machine, best first: "AVX-512", "AVX2", "SSE4" and
/// "SSE2" on x86-64, "baseline" elsewhere.
std::vector<std::string> simd_targets();
/// The instruction set in use.
std::string simd_target();
/// Select another of simd_targets(), for tests and benchmarks. Results do not depend on it. Must not be called while
/// evaluators run. Throws std::invalid_argument for an unknown name.
void use_simd_target(std::string_view name);

}  // namespace phasetree
