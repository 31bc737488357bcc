// The model of scene files: reading, writing and reading again, recording, evaluation, bounds, cells and rays in them.
#include <cmath>
#include <filesystem>

#include "fuzz/target.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/trace/tracer.hpp"
#include "source_directory.hpp"
#include "support/example_readers.hpp"

namespace phasetree::fuzz {

namespace {

constexpr std::size_t max_instructions = 300;  // of what is traced: an input is to take milliseconds
constexpr int most_questions = 60;             // whether building is cancelled: one for each box that is divided

const FileReaders readers = tests::example_readers();

// Files are sought beside the gallery's scenes.
Document document_of(std::string_view text) {
    return Document::from_text(std::string(text), source_directory() + "/scenes/input.json");
}

// Whether what nodes derive from their parameters takes milliseconds: samples of a network, scattered places.
bool is_modest(Value value) {
    if (value.is_number()) {
        const double v = value.number();
        return !(value.key() == "samples" && v > 500) && !(value.key() == "count" && v > 200);
    }
    for (const Value inner : value)
        if (!is_modest(inner)) return false;
    return true;
}

void evaluate(const Evaluator& evaluator, const Phased& object) {
    Evaluator::Workspace workspace;
    const bool is_short = evaluator.program().instructions.size() < 100;
    for (const glm::vec3 p : {glm::vec3(0), glm::vec3(0.3f, -0.2f, 0.7f), glm::vec3(-1, 2, 1), glm::vec3(1e6f)}) {
        const Phases<float> phi = evaluator.distances(p, workspace);
        int negative = 0;
        bool is_finite = true;
        for_each_phase(phi.present, [&](int i) {
            negative += phi[i] < 0;
            is_finite = is_finite && std::isfinite(phi[i]);
        });
        if (!is_finite) continue;
        promised(negative <= 1, "one component is negative at most");
        promised(label(phi) == evaluator.label(p, workspace), "a point's label is that of its distances");
        if (is_short) promised(label(phi) == label(distances(object, p)), "the program's label is the tree's");
        (void)evaluator.gradient(p, label(phi));
    }
}

void trace(const InterfaceTracer& tracer, const glm::vec3& origin, const glm::vec3& direction) {
    Evaluator::Workspace workspace;
    glm::vec3 start = origin;
    Phase phase = tracer.label(origin, workspace);
    for (int i = 0; i < 32; ++i) {
        const auto c = tracer.first_crossing(start, direction, 0, std::numeric_limits<float>::max(), phase, workspace);
        if (!c) return;
        promised(c->from == phase, "a crossing leaves the phase that was carried");
        promised(c->from != c->to, "a crossing is a change of phase");
        (void)tracer.normal(*c, direction);
        start = c->p_to;
        phase = c->to;
    }
}

void cut(const Phased& object) {
    int questions = 0;
    CellOptions options;
    options.max_depth = 6;
    options.quality = BuildQuality::low;
    options.cancelled = [&] { return ++questions > most_questions; };
    try {
        const InterfaceCells cells(object, options);
        (void)cells.statistics();
        Evaluator::Workspace workspace;
        TraceCounters counters;
        for (std::size_t i = 0; i < cells.size() && i < 16; ++i) {
            const glm::vec3 middle = cells.bounds(i).centre();
            (void)cells.label(i, middle, workspace);
            const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f));
            const glm::vec3 origin = middle - cells.bounds(i).diagonal() * direction;
            const auto c =
                cells.first_crossing(i, origin, direction, 0, 2 * cells.bounds(i).diagonal(), {}, workspace, counters);
            if (c) (void)cells.normal(i, *c, direction);
        }
    } catch (const BuildCancelled&) {
    }
}

}  // namespace

void run_scene(Bytes input) {
    try {
        const Document document = document_of(text_of(input));
        if (!is_modest(document.root())) return;
        const SceneTree tree = read_tree(document, readers);
        const std::string text = write_tree(tree);
        const SceneTree again = read_tree(document_of(text), readers);
        promised(write_tree(again) == text, "what is written and read again is the same");
        (void)statistics(tree.object);
        (void)phases(tree.object);
        const Bounds b = bounds(tree.object);
        const Evaluator evaluator(record(tree.object, 20'000));
        const FlushSubnormals flush;
        evaluate(evaluator, tree.object);
        if (evaluator.program().instructions.size() > max_instructions) return;
        const InterfaceTracer tracer(tree.object);
        const float size = b.diagonal();
        trace(tracer, b.centre() - size * glm::vec3(0, 0, 1), {0, 0, 1});
        trace(tracer, b.centre(), glm::normalize(glm::vec3(0.6f, -0.5f, 0.2f)));
        cut(tree.object);
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
