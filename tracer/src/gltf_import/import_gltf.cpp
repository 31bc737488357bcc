#include "gltf_import/import_gltf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "gltf_import/clear_phase.hpp"
#include "gltf_import/closed_gaps.hpp"
#include "gltf_import/contacts.hpp"
#include "gltf_import/json_layout.hpp"
#include "gltf_import/precedence.hpp"
#include "gltf_import/solids.hpp"
#include "gltf_import/surroundings.hpp"
#include "mesh_file/file_name.hpp"
#include "mesh_file/ply.hpp"
#include "output/utf8_name.hpp"
#include "phasetree/io/kind.hpp"
#include "phasetree/model/phase.hpp"
#include "scene/gltf_files.hpp"

namespace phasetree::tracer::gltf_import {

namespace {

using std::filesystem::path;

constexpr std::size_t max_phases = Phase::capacity - 1;

class Importer {
  public:
    Importer(const path& gltf, const path& scene, const ImportChoices& choices)
        : gltf_(gltf),
          scene_(scene),
          choices_(choices),
          file_(read_gltf_file(
              gltf, {.clear = gltf::ReadClear::as_solids,
                     .panes = choices.include_panes ? gltf::ReadPanes::as_clear : gltf::ReadPanes::as_thin_glass})) {
        for (const std::string& sentence : file_.not_shown) warn(sentence);
        if (file_.has_panes)
            warn(
                "clear materials without volume (KHR_materials_volume) become panes of \"thin_glass\"; use --solid if "
                "their objects are closed and solid");
        Solids made = solids_of(file_);
        for (std::string& warning : made.warnings) warn(std::move(warning));
        solids_ = std::move(made.solids);
        if (solids_.empty() && file_.parts.empty())
            throw ParameterError("file", fmt::format("{}: nothing can be imported: all its objects are clear, but none "
                                                     "encloses a volume that could become a phase",
                                                     gltf.string()) +
                                             reasons());
        require_traceable_size();
    }

    ImportedScene make() {
        name_phases();
        for (const Solid& solid : solids_) matter_.push_back(matter_of_solid(solid));
        contacts_ = contacts_of(solids_);
        precedence_ = precedence_of(solids_, matter_, contacts_);
        for (const std::string& warning : precedence_.warnings) warn(warning);
        if (choices_.closes_gaps) closed_gaps_ = closed_gaps(solids_, matter_, contacts_, precedence_.order);
        write_meshes();
        SceneJson scene{{"version", 1}};
        if (!solids_.empty()) {
            scene["phases"] = phases();
            scene["tree"] = with_closed_gaps(tree());
        }
        if (!file_.parts.empty()) scene["meshes"] = SceneJson::array({mesh()});
        const Bounds subject = subject_of();
        scene["lights"] = lights_of(file_, subject);
        scene["camera"] = camera_of(file_, subject);
        scene["render"] = render_settings_of(file_, subject, !solids_.empty(), is_dispersive_);
        made_.text = scene_text(scene);
        made_.report = report();
        return std::move(made_);
    }

  private:
    void warn(std::string sentence) { made_.warnings.push_back(std::move(sentence)); }

    // Single objects may be smaller.
    void require_traceable_size() const {
        if (solids_.empty()) return;
        const Bounds all = subject_of();
        const glm::vec3 farthest = glm::max(glm::abs(all.low), glm::abs(all.high));
        if (all.diagonal() > 1e-15f && std::max({farthest.x, farthest.y, farthest.z}) < 1e15f) return;
        throw ParameterError("file", fmt::format("{}: its clear objects are beyond what 32-bit floats can trace: their "
                                                 "diagonal is {:.2g} m, and sizes and positions must be between "
                                                 "10⁻¹⁵ and 10¹⁵ m; scale the file",
                                                 gltf_.string(), all.diagonal()));
    }

    std::string reasons() const {
        std::string text;
        for (const std::string& warning : made_.warnings) text += "\n  " + warning;
        return text;
    }

    // As stated in the file, or else derived from names and the refractive index.
    Matter matter_of_solid(const Solid& solid) {
        const auto stated = matter_named(solid.matter);
        if (stated) return *stated;
        if (!solid.matter.empty())
            warn(
                fmt::format("\"{}\" has the phasetree_matter \"{}\", which is not \"solid\", \"liquid\" or \"gas\"; it "
                            "is ignored",
                            solid.name, solid.matter));
        const gltf::NamedClearMaterial& material = file_.clear_materials[solid.material];
        return matter_of(solid.name, material.name, material.material.ior);
    }

    // The names of phases by material; the vacuum's is taken.
    void name_phases() {
        std::set<std::string> taken{"vacuum"};
        phase_names_.resize(file_.clear_materials.size());
        for (const Solid& solid : solids_) {
            std::string& name = phase_names_[solid.material];
            if (!name.empty()) continue;
            const std::string& wanted = file_.clear_materials[solid.material].name;
            name = wanted;
            for (int same = 2; !taken.insert(name).second; ++same) name = fmt::format("{} {}", wanted, same);
            used_materials_.push_back(solid.material);
        }
        if (used_materials_.size() > max_phases)
            throw ParameterError("file", fmt::format("{}: it has {} clear materials, but a scene can have only {} "
                                                     "phases; let objects share materials",
                                                     gltf_.string(), used_materials_.size(), max_phases));
    }

    SceneJson phases() {
        SceneJson phases;
        for (const std::size_t number : used_materials_) {
            double volume = 0, area = 0;
            for (const Solid& solid : solids_) {
                if (solid.material != number) continue;
                volume += solid.volume;
                area += solid.area;
            }
            std::vector<std::string> losses;
            const gltf::NamedClearMaterial& material = file_.clear_materials[number];
            SceneJson made = clear_phase(material.material, area > 0 ? 4 * volume / area : 0, losses);
            for (const std::string& loss : losses) warn(fmt::format("\"{}\" {}", material.name, loss));
            is_dispersive_ = is_dispersive_ || made["clear"].contains("abbe_number");
            phases[phase_names_[number]] = std::move(made);
        }
        return phases;
    }

    // Adds a PLY file for each solid to the result. The caller of import_gltf() writes them.
    void write_meshes() {
        const std::string folder = scene_.stem().string() + ".meshes/";
        require_utf8(folder);
        std::set<std::string> taken;  // in lower case, because some file systems ignore case
        const auto is_new = [&](std::string name) {
            std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
            return taken.insert(name).second;
        };
        for (const Solid& solid : solids_) {
            const std::string wanted = in_file_name(solid.name);
            std::string name = wanted;
            for (int same = 2; !is_new(name); ++same) name = fmt::format("{}_{}", wanted, same);
            made_.meshes.push_back({folder + name + ".ply", ply_of(solid.mesh)});
        }
    }

    SceneJson mesh_node(std::size_t solid) const { return {{"mesh", {{"file", made_.meshes[solid].file}}}}; }

    // Consecutive solids of the same phase form one "set".
    SceneJson tree() const {
        SceneJson objects = SceneJson::array();
        const std::vector<std::size_t>& order = precedence_.order;
        for (std::size_t i = 0, next = 0; i < order.size(); i = next) {
            SceneJson meshes = SceneJson::array();
            const std::size_t material = solids_[order[i]].material;
            for (; next < order.size() && solids_[order[next]].material == material; ++next)
                meshes.push_back(mesh_node(order[next]));
            SceneJson shape = meshes.size() == 1 ? meshes[0] : SceneJson{{"union", meshes}};
            objects.push_back({{"set", {{"phase", phase_names_[material]}, {"of", std::move(shape)}}}});
        }
        return objects.size() == 1 ? objects[0] : SceneJson{{"over", objects}};
    }

    SceneJson with_closed_gaps(SceneJson tree) const {
        if (!closed_gaps_) return tree;
        return {{"close_gaps",
                 {{"phases", names_of(closed_gaps_->materials)},
                  {"gap", short_number(closed_gaps_->gap)},
                  {"of", std::move(tree)}}}};
    }

    std::vector<std::string> names_of(const std::vector<std::size_t>& materials) const {
        std::vector<std::string> names;
        for (const std::size_t material : materials) names.push_back(phase_names_[material]);
        return names;
    }

    // The path of the glTF file relative to the folder of the scene.
    std::string named_from_scene() const {
        std::error_code problem;
        const path folder = scene_.has_parent_path() ? scene_.parent_path() : ".";
        const path relative = std::filesystem::relative(gltf_, folder, problem);
        const std::string name =
            (problem || relative.empty() ? std::filesystem::absolute(gltf_) : relative).generic_string();
        require_utf8(name);
        return name;
    }

    SceneJson mesh() const {
        SceneJson gltf{{"file", named_from_scene()}};
        if (!solids_.empty() || !file_.lights.empty()) {
            // The scene has the file's clear materials as phases, and its lights in "lights", so its reader need not
            // warn that the mesh ignores them.
            gltf["imported"] = true;
            if (file_.has_panes) gltf["panes"] = true;
        }
        return {{"gltf", std::move(gltf)}};
    }

    // The bounds around which the camera and the lights are placed.
    Bounds subject_of() const {
        Bounds subject;
        for (const Solid& solid : solids_) subject = unite(subject, solid.bounds);
        if (!solids_.empty()) return subject;
        for (const gltf::Part& part : file_.parts)
            for (const glm::vec3& p : part.mesh.vertices) subject = unite(subject, {z_up(p), z_up(p)});
        return subject;
    }

    std::string report() const {
        if (solids_.empty()) return "no clear objects; the scene has no tree\n";
        std::size_t widest_name = 6, widest_phase = 5;
        for (const Solid& solid : solids_) {
            widest_name = std::max(widest_name, solid.name.size());
            widest_phase = std::max(widest_phase, phase_names_[solid.material].size());
        }
        std::string text = fmt::format("{:>4}  {:<{}}  {:<{}}  {:<6}  {:>9}\n", "rank", "object", widest_name, "phase",
                                       widest_phase, "matter", "triangles");
        for (std::size_t i = 0; i < precedence_.order.size(); ++i) {
            const Solid& solid = solids_[precedence_.order[i]];
            text += fmt::format("{:>4}  {:<{}}  {:<{}}  {:<6}  {:>9}\n", i + 1, solid.name, widest_name,
                                phase_names_[solid.material], widest_phase, name_of(matter_[precedence_.order[i]]),
                                solid.mesh.triangles.size());
        }
        auto decision = precedence_.decisions.begin();
        for (const Contact& c : contacts_) {
            const std::string both = fmt::format("\"{}\" and \"{}\"", solids_[c.first].name, solids_[c.second].name);
            if (c.overlap()) {
                const Decision& d = *decision++;
                const bool is_one_phase = solids_[d.winner].material == solids_[d.loser].material;
                text += fmt::format("{} overlap by up to {:.3g} m; {}\n", both, c.depth,
                                    is_one_phase ? "both are the same phase"
                                                 : fmt::format("\"{}\" wins ({})", solids_[d.winner].name, d.reason));
            }
            if (c.gap)
                text += fmt::format("{} have a gap of {:.2g} to {:.2g} m along {:.0f} % of \"{}\"\n", both,
                                    c.gap->least, c.gap->greatest, 100 * c.gap->share, solids_[c.gap->of].name);
        }
        if (closed_gaps_)
            text +=
                fmt::format("gaps narrower than {:.2g} m between the phases {} are closed; --keep-gaps keeps them\n",
                            closed_gaps_->gap, fmt::join(names_of(closed_gaps_->materials), ", "));
        return text;
    }

    path gltf_, scene_;
    ImportChoices choices_;
    gltf::GltfFile file_;
    ImportedScene made_;
    std::vector<Solid> solids_;
    std::vector<Matter> matter_;
    std::vector<Contact> contacts_;
    Precedence precedence_;
    std::optional<ClosedGaps> closed_gaps_;
    std::vector<std::string> phase_names_;     // by material; empty for those that no solid has
    std::vector<std::size_t> used_materials_;  // in the order of the file
    bool is_dispersive_ = false;
};

}  // namespace

ImportedScene import_gltf(const path& gltf, const path& scene, const ImportChoices& choices) {
    return Importer(gltf, scene, choices).make();
}

}  // namespace phasetree::tracer::gltf_import
