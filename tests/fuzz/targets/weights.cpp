// The weights of a network, and a siren of them: its proven slope, its values and its gradient.
#include "fuzz/input_file.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/siren.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::fuzz {

void run_weights(Bytes input) {
    static InputFile file("weights.json");
    try {
        FromFile<SirenNetwork> weights{"weights.json",
                                       std::make_shared<const SirenNetwork>(read_siren(file.write(input)))};
        const Field siren = Siren{.file = std::move(weights)};
        const Evaluator evaluator(record(siren));
        const FlushSubnormals flush;
        Evaluator::Workspace workspace;
        for (const float x : {-1.0f, 0.0f, 0.3f}) {
            (void)evaluator.label({x, 0.1f, 0.2f}, workspace);
            (void)evaluator.gradient({x, 0.1f, 0.2f}, Phase{1});
        }
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
