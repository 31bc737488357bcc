#include "command/export_mesh.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/looks.hpp"
#include "command/numbers.hpp"
#include "command/overwritten_files.hpp"
#include "command/streams.hpp"
#include "command/unknown_phase.hpp"
#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "mesh_file/file_name.hpp"
#include "mesh_file/glb.hpp"
#include "mesh_file/obj.hpp"
#include "mesh_file/ply.hpp"
#include "mesh_file/stl.hpp"
#include "mesh_file/three_mf.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "phasetree/model/handle.hpp"
#include "render/threads.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

using std::filesystem::path;

constexpr std::array<std::string_view, 5> mesh_extensions{".stl", ".obj", ".ply", ".3mf", ".glb"};
constexpr std::string_view phase_in_name = "{phase}";

// Missed crossings are reported only above this share. Below it they are normal: every object with edges has some.
constexpr double share_of_edges = 0.05;

PhaseSet chosen_phases(const MeshExport& wanted, const SceneTree& tree) {
    const PhaseSet there = phases(tree.object);
    if (wanted.phases.empty()) return {there.bits & ~PhaseSet::of(phasetree::vacuum).bits};
    const std::vector<std::string>& names = tree.phases.names;
    PhaseSet chosen;
    for (const std::string& name : wanted.phases) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.begin())
            throw UsageError("--phase vacuum: the vacuum surrounds the object and cannot be exported");
        if (found == names.end()) throw unknown_phase("--phase", name, std::span(names).subspan(1));
        chosen = chosen | PhaseSet::of(Phase{static_cast<std::uint8_t>(found - names.begin())});
    }
    return chosen;
}

bool has_colors(const MeshExport& wanted) {
    return path(wanted.output).extension() != ".stl";
}

bool is_file_for_each_phase(const MeshExport& wanted) {
    return wanted.output.find(phase_in_name) != std::string::npos;
}

path file_of_phase(const std::string& pattern, const std::string& phase) {
    std::string name = pattern;
    for (std::size_t at = name.find(phase_in_name); at != std::string::npos; at = name.find(phase_in_name, at + 1))
        name.replace(at, phase_in_name.size(), in_file_name(phase));
    return name;
}

// The material file of an .obj, next to it.
path materials_of(path obj) {
    return obj.replace_extension(".mtl");
}

// File names do not depend on the mesh, so a file that cannot be written is reported before meshing.
std::vector<std::pair<Phase, path>> stl_files(const MeshExport& wanted, PhaseSet chosen, const PhaseNames& names) {
    std::vector<std::pair<Phase, path>> files;
    std::set<path> taken;
    for_each_phase(chosen.bits, [&](int i) {
        const Phase phase{static_cast<std::uint8_t>(i)};
        const path file = file_of_phase(wanted.output, names[phase]);
        if (!taken.insert(file).second)
            throw UsageError(
                fmt::format("two phases would be written to \"{}\"; choose one with --phase", file.string()));
        files.emplace_back(phase, file);
    });
    return files;
}

// All files to write.
std::vector<NamedFile> outputs_of(const MeshExport& wanted, PhaseSet chosen, const PhaseNames& names) {
    if (!is_file_for_each_phase(wanted)) {
        std::vector<NamedFile> files{{"--output", wanted.output}};
        if (path(wanted.output).extension() == ".obj") files.push_back({"--output", materials_of(wanted.output)});
        return files;
    }
    std::vector<NamedFile> files;
    for (const auto& [phase, file] : stl_files(wanted, chosen, names)) files.push_back({"--output", file});
    return files;
}

void write_mesh(const MeshedObject& object, const MeshExport& wanted, const PhaseNames& names) {
    const path output = wanted.output;
    const std::string extension = output.extension().string();
    if (extension == ".3mf") return write_file(three_mf_of(object), output);
    if (extension == ".glb") return write_file(glb_of(object), output);
    if (extension == ".ply") return write_file(ply_of(object), output);
    if (extension == ".obj") {
        const path materials = materials_of(output);
        const ObjFiles files = obj_of(object, materials.filename().string());
        // Write the surfaces last, so that everything they need exists when they appear.
        write_file(files.mtl, materials);
        return write_file(files.obj, output);
    }
    if (!is_file_for_each_phase(wanted)) return write_file(stl_of(surface_of(object.mesh, object.chosen)), output);
    for (const auto& [phase, file] : stl_files(wanted, object.chosen & object.mesh.phases(), names))
        write_file(stl_of(surface_of(object.mesh, PhaseSet::of(phase))), file);
}

void say_what_is_lost(const MeshedObject& object) {
    const PhaseMesh& mesh = object.mesh;
    for (const Phase phase : object.phases())
        if (!(surface_of(mesh, PhaseSet::of(phase)).volume() > 0))
            say("phasetree: warning: the surface of \"{}\" is inside out, because it is much thinner than the spacing "
                "of "
                "{:.4g}; reduce --spacing\n",
                object.look(phase).name, mesh.spacing);
    for_each_phase(object.chosen.bits & ~mesh.phases().bits, [&](int i) {
        say("phasetree: warning: \"{}\" has no triangles: it is absent, or thinner than the spacing of {:.4g}\n",
            object.looks[static_cast<std::size_t>(i)].name, mesh.spacing);
    });
    const double share =
        mesh.crossings > 0 ? static_cast<double>(mesh.skipped) / static_cast<double>(mesh.crossings) : 0;
    if (share > share_of_edges)
        say("phasetree: warning: {:.0f} % of the crossings along the grid were missed, at edges and where phases are "
            "thinner than the spacing of {:.4g}; reduce --spacing\n",
            100 * share, mesh.spacing);
}

MeshedObject meshed(const SceneFile& file, const MeshExport& wanted, const Document& document, const SceneTree& tree) {
    MeshedObject object;
    object.chosen = chosen_phases(wanted, tree);
    // Reads only what a mesh needs: the scene may lack a camera and lights.
    std::vector<std::optional<Material>> materials;
    if (has_colors(wanted)) materials = read_materials(document);
    for (const NamedFile& output : outputs_of(wanted, object.chosen, tree.phases)) check_file_writable(output.path);
    check_overwrites(file, document, outputs_of(wanted, object.chosen, tree.phases));
    CellOptions cells;
    cells.quality = BuildQuality::low;
    cells.max_bytes = wanted.max_bytes;
    cells.cancelled = [] { return interrupted(); };
    LateProgress preparing(ProgressOutput::standard_error(false), "preparing the object");
    cells.progress = [&](float done) { preparing.tell(done); };
    (void)record_tree(document, tree.object);  // throws a precise error if the object is too large
    const auto prepared =
        made_of_tree(document, [&] { return std::make_unique<const embree::PreparedObject>(tree.object, cells); });
    print_warning(file.shown(), prepared->cells().warning());
    const Bounds& bounds = prepared->cells().bounds();
    object.looks = has_colors(wanted) ? looks_of(tree.phases, materials, bounds) : looks_without_materials(tree.phases);
    MeshOptions options;
    options.spacing = wanted.spacing;
    options.cancelled = [] { return interrupted(); };
    LateProgress meshing(ProgressOutput::standard_error(false), "meshing the object");
    options.progress = [&](float done) { meshing.tell(done); };
    try {
        object.mesh = mesh_of(bounds, embree::line_tracer(prepared->scene()), options);
    } catch (const ModelError& e) {
        throw UsageError(fmt::format("--spacing: {}", e.what()));
    }
    return object;
}

// Rejects lengths that other programs could not represent, also when squared.
void check_scale(const PhaseMesh& mesh, float scale) {
    constexpr float most = 1e15f;
    float farthest = 0;
    for (const glm::vec3& v : mesh.vertices)
        farthest = std::max({farthest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (farthest * scale > most || mesh.spacing * scale < 1 / most)
        throw UsageError(fmt::format("--scale {}: the coordinates would be too {} for other programs", scale,
                                     farthest * scale > most ? "large" : "small"));
}

int report_interruption() {
    say("phasetree: interrupted; no file was written\n");
    return code_of_interruption(false);
}

}  // namespace

bool is_mesh_extension(std::string_view extension) {
    return std::find(mesh_extensions.begin(), mesh_extensions.end(), extension) != mesh_extensions.end();
}

int export_mesh(const SceneFile& file, const MeshExport& wanted) {
    const AvailableThreads threads;
    if (is_file_for_each_phase(wanted) && path(wanted.output).extension() != ".stl")
        throw UsageError(
            fmt::format("{} requires an .stl file; the other formats store all phases in one file", phase_in_name));
    const Document document = read_document(file);
    const SceneTree tree = read_model(document, wanted.object);
    const InterruptGuard guard;
    MeshedObject object;
    try {
        object = meshed(file, wanted, document, tree);
    } catch (const BuildCancelled&) {
        return report_interruption();
    } catch (const MeshingCancelled&) {
        return report_interruption();
    }
    if (object.phases().empty())
        throw UsageError(
            fmt::format("cannot write \"{}\": there are no triangles at a spacing of {:.4g}; reduce --spacing",
                        wanted.output, object.mesh.spacing));
    say_what_is_lost(object);
    check_scale(object.mesh, wanted.scale);
    for (glm::vec3& v : object.mesh.vertices) v *= wanted.scale;
    object.scale = wanted.scale;
    try {
        write_mesh(object, wanted, tree.phases);
    } catch (const std::length_error& e) {
        throw UsageError(fmt::format("cannot write \"{}\": {}", wanted.output, e.what()));
    }
    return exit_code::success;
}

}  // namespace phasetree::tracer
