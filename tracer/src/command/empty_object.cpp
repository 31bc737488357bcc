#include "command/empty_object.hpp"

#include "command/load.hpp"

#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::tracer {

bool is_empty(const Phased& object, const Evaluator& evaluator) {
    const Bounds b = bounds(object);
    if (b.empty()) return true;
    if (!b.finite()) return false;
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    constexpr int side = 20;
    const auto share = [](int i) { return (static_cast<float>(i) + 0.5f) / side; };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < side; ++k)
                if (evaluator.label(b.low + (b.high - b.low) * glm::vec3(share(i), share(j), share(k)), workspace) !=
                    phasetree::vacuum)
                    return false;
    try {
        return InterfaceCells(object, {.quality = BuildQuality::low}).size() == 0;
    } catch (const ModelError&) {
        return false;  // too small or too large for rays; reported elsewhere
    }
}

std::string empty_object_warning(const Document& document) {
    return document
        .error(model_in(document), "warning: the object is empty: everything has been cut away, so no ray hits it")
        .what();
}

}  // namespace phasetree::tracer
