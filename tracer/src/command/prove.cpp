#include "command/prove.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "command/duration.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/number_in.hpp"
#include "command/reading.hpp"
#include "command/streams.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "phasetree/measuring/prove.hpp"
#include "render/threads.hpp"
#include "scene/expectations.hpp"
#include "scene/model_with_places.hpp"

namespace phasetree::tracer {

namespace {

using Json = nlohmann::ordered_json;

// A statement, and what is known about it.
struct Outcome {
    Expectation expectation;
    Proof proof;
};

// What is known of a node that is in the file.
struct PlacedEffect {
    NodeEffect effect;
    NodePlace place;
};

std::string name_of_statement(const Statement& s) {
    constexpr std::array names{"present", "connected", "closed",        "apart",       "touching",
                               "wall",    "volume",    "no_dead_nodes", "tight_bounds"};
    return names[s.index()];
}

// The statements for a scene without "expect": each phase exists and is connected.
std::vector<Expectation> usual_expectations(const SceneTree& tree) {
    std::vector<Expectation> all;
    for_each_phase(phases(tree.object).bits & ~PhaseSet::of(phasetree::vacuum).bits, [&](int i) {
        const Phase phase{static_cast<std::uint8_t>(i)};
        for (const Statement& statement : {Statement(IsPresent{phase}), Statement(IsConnected{phase})}) {
            const Json text{{name_of_statement(statement), {{"phase", tree.phases[phase]}}}};
            all.push_back({{statement, 1, ""}, text.dump(), 0});
        }
    });
    return all;
}

std::string point_text(const glm::vec3& p) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

// The text about the points, which follows the statement and the reason.
std::string witness_text(const Outcome& outcome, const PhaseNames& names) {
    const std::vector<Witness>& points = outcome.proof.witnesses;
    if (points.empty()) return "";
    const auto text = [&](const Witness& w) {
        return fmt::format("\"{}\" at {}", names[w.phase], point_text(w.point));
    };
    if (points.size() == 1) return fmt::format("; see {}", text(points.front()));
    if (std::holds_alternative<IsClosed>(outcome.expectation.statement))
        return fmt::format("; it begins in {} and has {} points (--json prints them)", text(points.front()),
                           points.size());
    return fmt::format("; see {} and {}", text(points.front()), text(points.back()));
}

// A statement of the file without its line breaks and comments.
std::string in_one_line(const std::string& text) {
    std::string line;
    const auto ends_with_bracket = [&] { return !line.empty() && (line.back() == '{' || line.back() == '['); };
    bool is_in_string = false, is_space_due = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
        if (!is_in_string && c == '/' && (next == '/' || next == '*')) {
            const std::size_t end = next == '/' ? text.find('\n', i) : text.find("*/", i + 2) + 1;
            i = std::min(end, text.size());
            is_space_due = true;
        } else if (!is_in_string && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) {
            is_space_due = true;
        } else {
            if (is_space_due && !ends_with_bracket() && c != '}' && c != ']' && c != ',') line += ' ';
            is_space_due = false;
            line += c;
            if (is_in_string && c == '\\' && i + 1 < text.size())
                line += text[++i];
            else if (c == '"')
                is_in_string = !is_in_string;
        }
    }
    return line;
}

// Why a statement is undecided, and what would help; why it is refuted.
std::string reason_text(const Proof& proof) {
    if (proof.reason.empty()) return "";
    const std::string reached =
        proof.resolution > 0 ? fmt::format(" at boxes of {:.3g} units of length", proof.resolution) : "";
    if (proof.reason == "time ran out") return fmt::format(": time ran out{}; allow more with --time", reached);
    if (proof.reason == "the resolution is too coarse")
        return fmt::format(": the resolution is too coarse{}; choose a finer one with --resolution", reached);
    return ": " + proof.reason;
}

std::string interval_text(const Outcome& outcome) {
    if (!std::holds_alternative<HasVolume>(outcome.expectation.statement) || outcome.proof.measured.high == 0)
        return "";
    const Measured& m = outcome.proof.measured;
    if (!std::isfinite(m.low) || !std::isfinite(m.high)) return "";
    return fmt::format("; it is from {:.7g} to {:.7g} {}", m.low / outcome.expectation.unit,
                       m.high / outcome.expectation.unit, outcome.expectation.unit_name);
}

void print_text(const std::string& scene, const Document& document, const std::vector<Outcome>& outcomes,
                const PhaseNames& names) {
    for (const Outcome& outcome : outcomes) {
        const std::string verdict =
            fmt::format("{}: {}{}{}{}", name_of(outcome.proof.verdict), in_one_line(outcome.expectation.text),
                        reason_text(outcome.proof), interval_text(outcome), witness_text(outcome, names));
        std::string place = scene;
        if (outcome.expectation.offset > 0) {
            const SceneError e = document.error(outcome.expectation.offset, "");
            place = fmt::format("{}:{}:{}", scene, e.line(), e.column());
        }
        put("{}: {}\n", place, verdict);
    }
}

// What can be left out, in words: the node, and which operand replaces it.
std::string removal_text(const NodeEffect& e, const NodePlaces& places) {
    if (e.is_replaced())
        return fmt::format("\"{}\" changes no label: its operand \"{}\" alone gives the same object", name_of(e.node),
                           name_of(*e.kept));
    const auto parent = places.find(address_of(e.parent));
    return fmt::format("\"{}\" changes no label: without it, the \"{}\"{} gives the same object", name_of(e.node),
                       name_of(e.parent),
                       parent ? fmt::format(" in line {}, column {}", parent->line, parent->column) : "");
}

// The nodes in the file that are known to change something or nothing, in the order of the file.
std::vector<PlacedEffect> placed_effects(const std::vector<NodeEffect>& effects, const NodePlaces& places) {
    std::vector<PlacedEffect> placed;
    for (const NodeEffect& e : effects)
        if (const auto place = places.find(address_of(e.node))) placed.push_back({e, *place});
    std::ranges::stable_sort(placed, {}, [](const PlacedEffect& e) { return std::pair(e.place.file, e.place.offset); });
    return placed;
}

void warn_of_dead_nodes(const std::vector<PlacedEffect>& effects, const NodePlaces& places) {
    for (const auto& [effect, place] : effects)
        if (effect.is_dead == Verdict::proved)
            say("{}:{}:{}: warning: {}\n", place.file, place.line, place.column, removal_text(effect, places));
}

void warn_of_loose_bounds(const std::string& scene, const Document& document, const Proof& proof) {
    if (proof.verdict != Verdict::refuted) return;
    std::string place = scene;
    if (const std::optional<Value> tree = document.root().find("tree")) {
        const SceneError e = document.error(*tree, "");
        place = fmt::format("{}:{}:{}", scene, e.line(), e.column());
    }
    say("{}: warning: {}\n", place, proof.reason);
}

Json json_of(const PlacedEffect& placed, const PhaseNames& names) {
    const auto& [effect, place] = placed;
    Json one{{"file", place.file},
             {"line", place.line},
             {"column", place.column},
             {"node", name_of(effect.node)},
             {"left_out_of", name_of(effect.parent)}};
    if (effect.kept) one["kept"] = name_of(*effect.kept);
    one["is_dead"] = name_of(effect.is_dead);
    if (const auto& c = effect.change)
        one["change"] = {
            {"point", {c->point.x, c->point.y, c->point.z}}, {"with", names[c->with]}, {"without", names[c->without]}};
    return one;
}

void print_json(const std::string& scene, const Document& document, const std::vector<Outcome>& outcomes,
                const std::vector<PlacedEffect>& effects, const PhaseNames& names) {
    Json json{{"scene", scene}};
    Json& list = json["statements"] = Json::array();
    for (const Outcome& outcome : outcomes) {
        Json one;
        if (outcome.expectation.offset > 0) {
            const SceneError place = document.error(outcome.expectation.offset, "");
            one["line"] = place.line();
            one["column"] = place.column();
        }
        one["statement"] = Json::parse(outcome.expectation.text, nullptr, false, true);
        one["verdict"] = name_of(outcome.proof.verdict);
        if (!outcome.proof.reason.empty()) one["reason"] = outcome.proof.reason;
        if (outcome.proof.resolution > 0) one["resolution"] = outcome.proof.resolution;
        if (std::holds_alternative<HasVolume>(outcome.expectation.statement))
            one["interval"] = {{"low", outcome.proof.measured.low / outcome.expectation.unit},
                               {"high", outcome.proof.measured.high / outcome.expectation.unit},
                               {"unit", outcome.expectation.unit_name}};
        Json& points = one["witnesses"] = Json::array();
        for (const Witness& w : outcome.proof.witnesses)
            points.push_back({{"point", {w.point.x, w.point.y, w.point.z}}, {"phase", names[w.phase]}});
        list.push_back(one);
    }
    Json& nodes = json["nodes"] = Json::array();
    for (const PlacedEffect& e : effects) nodes.push_back(json_of(e, names));
    put("{}\n", json.dump(2));
}

int code_of(const std::vector<Outcome>& outcomes, bool is_expected) {
    if (!is_expected) return exit_code::success;
    const auto has = [&](Verdict v) {
        return std::ranges::any_of(outcomes, [&](const Outcome& outcome) { return outcome.proof.verdict == v; });
    };
    if (has(Verdict::refuted)) return exit_code::refuted;
    return has(Verdict::undecided) ? exit_code::undecided : exit_code::success;
}

// A scene, and the statements about it.
struct WhatToProve {
    Document document;
    NodePlaces places;
    SceneTree tree;
    std::vector<Expectation> expected;
    bool is_expected = false;  // whether the scene has statements of its own
};

WhatToProve read_what_to_prove(const SceneFile& file, const ProveCommand& chosen) {
    const EndingAtOnce at_once = ending_before_results();
    const Document document = read_document(file);
    NodePlaces places;
    const SceneModel model = read_scene_model(document, places);
    const SceneTree tree = tree_of_model(document, model, chosen.object);
    (void)record_tree(document, tree.object);  // throws a precise error if the object is too large
    std::vector<Expectation> expected =
        read_expectations(document, {model.phases, model.unit ? model.unit->metres : 1, model.densities});
    const bool is_expected = !expected.empty();
    if (!is_expected) expected = usual_expectations(tree);
    return {document, places, tree, expected, is_expected};
}

}  // namespace

void add_prove_options(CLI::App& command, ProveCommand& options) {
    CLI::Option* const prove =
        command.add_flag("--prove", options.is_wanted, "Prove or refute the statements in the scene's \"expect\"");
    command.add_option("--object", options.object, "With --prove: use only this object of a scene with several")
        ->needs(prove)
        ->option_text("NAME");
    command
        .add_option("--resolution", options.resolution,
                    "With --prove: side of the smallest boxes, in the scene's unit; smaller features stay undecided "
                    "(default: 1/256 of the longest side)")
        ->check(number_in(1e-15, 1e15))
        ->needs(prove)
        ->option_text("LENGTH");
    add_duration(command, "--time", options.seconds, "With --prove: stop after this time (default: 60s)")->needs(prove);
    command.add_flag("--json", options.as_json, "With --prove: print JSON")->needs(prove);
}

int prove_scene(const SceneFile& file, const ProveCommand& chosen) {
    const AvailableThreads threads;
    const InterruptGuard guard;
    const WhatToProve given = read_what_to_prove(file, chosen);
    const Document& document = given.document;
    const SceneTree& tree = given.tree;
    const std::vector<Expectation>& expected = given.expected;
    std::vector<Statement> statements;
    for (const Expectation& e : expected) statements.push_back(e.statement);
    // Loose bounds and dead nodes are looked for in any case, for warnings.
    statements.emplace_back(HasTightBounds());
    statements.emplace_back(HasNoDeadNodes());
    LateProgress progress(ProgressOutput::standard_error(false), "proving");
    ProveOptions options;
    options.resolution = chosen.resolution;
    options.seconds = chosen.seconds;
    options.cancelled = [] { return interrupted(); };
    options.progress = [&](float share) { progress.tell(share); };
    const std::vector<Proof> proofs = made_of_tree(document, [&] { return prove(tree.object, statements, options); });
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < expected.size(); ++i) outcomes.push_back({expected[i], proofs[i]});
    const std::vector<PlacedEffect> effects = placed_effects(proofs.back().nodes, given.places);
    warn_of_dead_nodes(effects, given.places);
    warn_of_loose_bounds(file.shown(), document, proofs[expected.size()]);
    if (chosen.as_json)
        print_json(file.shown(), document, outcomes, effects, tree.phases);
    else
        print_text(file.shown(), document, outcomes, tree.phases);
    if (!interrupted()) return code_of(outcomes, given.is_expected);
    say("phasetree: interrupted; printed what was known by then\n");
    return code_of_interruption(false);
}

}  // namespace phasetree::tracer
