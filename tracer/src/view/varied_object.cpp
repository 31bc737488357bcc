#include "view/varied_object.hpp"

#include <utility>

#include "phasetree/model/poll_preparation.hpp"
#include "scene/one_tree.hpp"
#include "scene/placed.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer::view {

VariedObject::VariedObject(Document document, Parse parse) : document_(std::move(document)), parse_(std::move(parse)) {
    const Phased object = read(document_, &phases_);
    const Bounds bounds = phasetree::bounds(object);
    if (!bounds.empty() && bounds.finite()) size_ = 0.5 * double{bounds.diagonal()};
    last_ = std::make_shared<const PreciseEvaluator>(object);
}

Phased VariedObject::read(const Document& document, PhaseNames* phases) const {
    poll_preparation();
    ++readings_;
    kept_->start();
    const Document model = document.without_assets().with_kept_nodes(kept_);
    Phased object;
    if (has_objects(model)) {
        const ObjectsModel several = read_placed_objects(model);
        if (phases) *phases = several.phases;
        object = as_one_tree(several.placed);
    } else {
        SceneTree tree = read_tree(model, file_readers());
        if (phases) *phases = std::move(tree.phases);
        object = tree.object;
    }
    kept_->finish();
    return object;
}

std::shared_ptr<const PreciseEvaluator> VariedObject::with(const NumberEdits& numbers) const {
    if (numbers == last_numbers_ && last_) return last_;
    try {
        const Document document = parse_(with_numbers(document_, numbers)).at(document_.seconds());
        last_ = std::make_shared<const PreciseEvaluator>(read(document, nullptr));
        last_numbers_ = numbers;
    } catch (const SceneError&) {
        return nullptr;
    } catch (const ModelError&) {
        return nullptr;
    }
    return last_;
}

}  // namespace phasetree::tracer::view
