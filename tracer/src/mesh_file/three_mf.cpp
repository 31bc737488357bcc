#include "mesh_file/three_mf.hpp"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "mesh_file/zip.hpp"

namespace phasetree::tracer {

namespace {

constexpr const char* content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
<Default Extension="config" ContentType="application/xml"/>
</Types>
)";
constexpr const char* relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";

// Escapes text for an attribute value in XML 1.0, which excludes control characters, U+FFFE and U+FFFF.
std::string in_xml(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (text.substr(i, 3) == "\xef\xbf\xbe" || text.substr(i, 3) == "\xef\xbf\xbf") {
            result += ' ';
            i += 2;
            continue;
        }
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else
            result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return result;
}

constexpr int materials_id = 1, object_id = 2;

// Writes one mesh with the surfaces of all parts, and collects what PrusaSlicer needs to tell them apart. Components
// are not used, because PrusaSlicer would load them as separate objects.
class Writer {
  public:
    explicit Writer(const MeshedObject& object) : object_(object), phases_(object.phases()) {
        for (const Phase phase : phases_) add(phase);
    }

    std::string model() const {
        std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Application">phasetree</metadata>
<resources>
)";
        auto out = std::back_inserter(text);
        fmt::format_to(out, "<basematerials id=\"{}\">\n", materials_id);
        for (const Phase phase : phases_) {
            const Look& look = object_.look(phase);
            const auto c = shown_color(look);
            fmt::format_to(out, "<base name=\"{}\" displaycolor=\"#{:02X}{:02X}{:02X}\"/>\n", in_xml(look.name), c[0],
                           c[1], c[2]);
        }
        fmt::format_to(out,
                       "</basematerials>\n<object id=\"{}\" type=\"model\" pid=\"{}\" "
                       "pindex=\"0\">\n<mesh>\n<vertices>\n{}</vertices>\n<triangles>\n{}</triangles>\n"
                       "</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"{}\"/>\n</build>\n</model>\n",
                       object_id, materials_id, vertices_, triangles_, object_id);
        return text;
    }
    std::string parts() const {
        return fmt::format(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n<object id=\"{}\">\n{}</object>\n</config>\n",
            object_id, parts_);
    }

  private:
    void add(Phase phase) {
        const ClosedMesh mesh = surface_of(object_.mesh, PhaseSet::of(phase));
        for (const glm::vec3& v : mesh.vertices)
            fmt::format_to(std::back_inserter(vertices_), "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", v.x, v.y, v.z);
        for (const auto& t : mesh.triangles)
            fmt::format_to(std::back_inserter(triangles_),
                           "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" pid=\"{}\" p1=\"{}\"/>\n", t[0] + vertex_count_,
                           t[1] + vertex_count_, t[2] + vertex_count_, materials_id, part_count_);
        if (mesh.triangles.empty()) return;
        // Each part has its own extruder, numbered from 1.
        fmt::format_to(std::back_inserter(parts_),
                       "<volume firstid=\"{}\" lastid=\"{}\">\n"
                       "<metadata type=\"volume\" key=\"name\" value=\"{}\"/>\n"
                       "<metadata type=\"volume\" key=\"volume_type\" value=\"ModelPart\"/>\n"
                       "<metadata type=\"volume\" key=\"extruder\" value=\"{}\"/>\n</volume>\n",
                       triangle_count_, triangle_count_ + mesh.triangles.size() - 1, in_xml(object_.look(phase).name),
                       part_count_ + 1);
        vertex_count_ += mesh.vertices.size();
        triangle_count_ += mesh.triangles.size();
        ++part_count_;
    }

    const MeshedObject& object_;
    std::vector<Phase> phases_;
    std::string vertices_, triangles_, parts_;
    std::size_t vertex_count_ = 0, triangle_count_ = 0, part_count_ = 0;
};

}  // namespace

std::string three_mf_of(const MeshedObject& object) {
    const Writer writer(object);
    const ZipFile files[] = {{"[Content_Types].xml", content_types},
                             {"_rels/.rels", relationships},
                             {"3D/3dmodel.model", writer.model()},
                             {"Metadata/Slic3r_PE_model.config", writer.parts()}};
    return zip_of(files);
}

}  // namespace phasetree::tracer
