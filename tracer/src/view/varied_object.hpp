// The object of a scene with other numbers: what the derivatives by parameters are taken of.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "phasetree/evaluation/precise_evaluator.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/kept_nodes.hpp"
#include "phasetree/io/tree.hpp"
#include "view/numbers.hpp"

namespace phasetree::tracer::view {

/// Reads the object again for each set of numbers, because nodes may derive data from their parameters. What nodes read
/// from files is kept. Objects of a scene with several are one tree, as in the picture. Not thread-safe.
class VariedObject {
  public:
    /// Makes a document of a text, with the program's options for reading it. Throws SceneError.
    using Parse = std::function<Document(std::string)>;

    /// Throws SceneError and ModelError.
    VariedObject(Document document, Parse parse);

    const Document& document() const { return document_; }
    const PhaseNames& phases() const { return phases_; }
    /// Half the diagonal of the object's bounds; 1 if it is unbounded.
    double size() const { return size_; }

    /// The object with other numbers; null if a node rejects them.
    std::shared_ptr<const PreciseEvaluator> with(const NumberEdits& numbers) const;
    /// How often the object has been read.
    std::size_t readings() const { return readings_; }

  private:
    Phased read(const Document& document, PhaseNames* phases) const;

    Document document_;
    Parse parse_;
    PhaseNames phases_;
    double size_ = 1;
    std::shared_ptr<KeptNodes> kept_ = std::make_shared<KeptNodes>();
    mutable std::size_t readings_ = 0;
    mutable NumberEdits last_numbers_;
    mutable std::shared_ptr<const PreciseEvaluator> last_;
};

}  // namespace phasetree::tracer::view
