#include "mesh_file/three_mf.hpp"

#include <fmt/format.h>

#include <iterator>

#include "mesh_file/zip.hpp"

namespace phasetree::tracer {

namespace {

constexpr const char* content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
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

std::string model_of(const MeshedObject& object) {
    const std::vector<Phase> phases = object.phases();
    std::string text = R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Application">phasetree</metadata>
<resources>
<basematerials id="1">
)";
    auto out = std::back_inserter(text);
    for (const Phase phase : phases) {
        const Look& look = object.look(phase);
        const auto c = shown_color(look);
        fmt::format_to(out, "<base name=\"{}\" displaycolor=\"#{:02X}{:02X}{:02X}\"/>\n", in_xml(look.name), c[0], c[1],
                       c[2]);
    }
    text += "</basematerials>\n";
    for (std::size_t i = 0; i < phases.size(); ++i) {
        const ClosedMesh mesh = surface_of(object.mesh, PhaseSet::of(phases[i]));
        fmt::format_to(out,
                       "<object id=\"{}\" type=\"model\" name=\"{}\" pid=\"1\" pindex=\"{}\">\n<mesh>\n<vertices>\n",
                       i + 2, in_xml(object.look(phases[i]).name), i);
        for (const glm::vec3& v : mesh.vertices)
            fmt::format_to(out, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", v.x, v.y, v.z);
        text += "</vertices>\n<triangles>\n";
        for (const auto& t : mesh.triangles)
            fmt::format_to(out, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", t[0], t[1], t[2]);
        text += "</triangles>\n</mesh>\n</object>\n";
    }
    const std::size_t whole = phases.size() + 2;
    fmt::format_to(out, "<object id=\"{}\" type=\"model\">\n<components>\n", whole);
    for (std::size_t i = 0; i < phases.size(); ++i) fmt::format_to(out, "<component objectid=\"{}\"/>\n", i + 2);
    fmt::format_to(
        out, "</components>\n</object>\n</resources>\n<build>\n<item objectid=\"{}\"/>\n</build>\n</model>\n", whole);
    return text;
}

}  // namespace

std::string three_mf_of(const MeshedObject& object) {
    const ZipFile files[] = {
        {"[Content_Types].xml", content_types}, {"_rels/.rels", relationships}, {"3D/3dmodel.model", model_of(object)}};
    return zip_of(files);
}

}  // namespace phasetree::tracer
