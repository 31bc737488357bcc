#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "api/errors.hpp"
#include "api/handles.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/trace/precise_tracer.hpp"

namespace phasetree::embree::api {

/// A tree in double precision, prepared by the first call that uses it. Any thread may use it.
class PreciseTree {
  public:
    const PreciseEvaluator& evaluator(const Phased& object);
    /// Throws ModelError if the object cannot be traced.
    const PreciseTracer& tracer(const Phased& object);

  private:
    std::once_flag evaluator_made_, tracer_made_;
    std::optional<PreciseEvaluator> evaluator_;
    std::optional<PreciseTracer> tracer_;
};

/// The data behind a PhasetreeTree: the model, and the text that it was read from, for edits.
struct TreeData {
    Document document;
    std::optional<PhasetreeFileReader> reader;
    SceneTree tree;
    std::vector<std::optional<std::string>> materials;  ///< per phase, as JSON
    std::unique_ptr<PreciseTree> precise = std::make_unique<PreciseTree>();
};

using TreeTable = HandleTable<TreeData, 0x5054>;

/// Throws if the handle is invalid.
const TreeData& data_of(PhasetreeTree handle);

/// The position where a value ends in its text.
std::size_t end_of(const std::string& text, const Value&);
/// The text of a value without comments.
std::string json_of(const Document&, const Value&);

/// The scene's text with the value at a JSON Pointer (RFC 6901) replaced. Throws ApiError if there is no such value.
std::string with_value(const Document&, std::string_view pointer, std::string_view value);

}  // namespace phasetree::embree::api
