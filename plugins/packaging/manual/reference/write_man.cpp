#include <fstream>

#include "reference/markup.hpp"
#include "reference/text.hpp"
#include "reference/write.hpp"
#include "roff.hpp"

namespace phasetree::manual {

namespace {

constexpr const char* overview = "phasetree_embree";

std::string prose(const std::string& text) {
    std::string out;
    for (const Span& span : spans_of(text)) {
        switch (span.style) {
            case Style::plain:
                out += roff(span.text, out.empty());
                break;
            case Style::emphasis:
                out += "\\fI" + roff(span.text) + "\\fR";
                break;
            case Style::code:
            case Style::name:
                out += "\\fB" + roff_code(span.text) + "\\fR";
                break;
        }
    }
    return out;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

class ManPage {
  public:
    ManPage(const std::filesystem::path& folder, const std::string& name, const std::string& version)
        : file_(folder / (name + ".3")) {
        file_.exceptions(std::ios::failbit | std::ios::badbit);
        file_ << ".TH " << name << " 3 \"\" \"phasetree " << version << "\" \"phasetree for Embree\"\n"
              << ".nh\n.ad l\n";
    }

    void section(const std::string& title) { file_ << ".SH \"" << title << "\"\n"; }
    void subsection(const std::string& title) { file_ << ".SS \"" << roff(title) << "\"\n"; }

    void name(const std::vector<std::string>& names, const std::string& summary) {
        section("NAME");
        file_ << joined(names, ", ") << " \\- " << roff(plain(summary)) << "\n";
    }

    void code(const std::string& text) {
        file_ << ".PP\n.nf\n";
        for (const std::string& line : split(text, '\n')) file_ << roff_code(line) << "\n";
        file_ << ".fi\n";
    }

    void blocks(const std::vector<Block>& blocks) {
        for (const Block& block : blocks) {
            if (!block.text.empty()) file_ << ".PP\n" << prose(block.text) << "\n";
            definitions(block.definitions);
        }
    }

    void definitions(const std::vector<Definition>& definitions) {
        for (const Definition& definition : definitions)
            file_ << ".TP\n.B " << roff_code(joined(definition.terms, ", ")) << "\n" << prose(definition.text) << "\n";
    }

    void references(const std::vector<std::string>& names) {
        for (std::size_t i = 0; i < names.size(); ++i)
            file_ << ".BR " << names[i] << " (3)" << (i + 1 < names.size() ? "," : "") << "\n";
    }

  private:
    std::ofstream file_;
};

const std::string inclusion = "#include <phasetree/phasetree_embree.h>\n";

void write_page(const Page& page, const std::filesystem::path& folder, const std::string& version) {
    ManPage man(folder, page.names.front(), version);
    man.name(page.names, page.summary);
    man.section("SYNOPSIS");
    man.code(inclusion + "\n" + page.synopsis);
    man.section("DESCRIPTION");
    man.blocks(page.description);
    if (!page.parameters.empty()) {
        man.section("PARAMETERS");
        man.definitions(page.parameters);
    }
    if (!page.result.empty()) {
        man.section("RETURN VALUE");
        man.blocks(page.result);
    }
    if (!page.errors.empty()) {
        man.section("ERRORS");
        man.definitions(page.errors);
    }
    man.section("SEE ALSO");
    std::vector<std::string> related{overview};
    related.insert(related.end(), page.related.begin(), page.related.end());
    man.references(related);
    for (std::size_t i = 1; i < page.names.size(); ++i)
        std::ofstream(folder / (page.names[i] + ".3")) << ".so man3/" << page.names.front() << ".3\n";
}

void write_overview(const Reference& reference, const std::filesystem::path& folder) {
    ManPage man(folder, overview, reference.version);
    man.name({overview}, summary_of(reference.conventions));
    man.section("SYNOPSIS");
    man.code(inclusion + "\ncc program.c $(pkg-config --cflags --libs phasetree-embree3)");
    man.section("DESCRIPTION");
    man.blocks(reference.conventions);
    man.section("CALLS AND STRUCTURES");
    for (const Section& section : reference.sections) {
        man.subsection(section.title);
        for (const Page* page : section.pages) man.definitions({{page->names, page->summary}});
    }
    man.section("TYPES AND CONSTANTS");
    for (const Section& section : reference.sections)
        for (const Entry& entry : section.others) {
            std::string text;
            for (const Declaration& declaration : entry.declarations)
                text += (text.empty() ? "" : "\n") + declaration.text;
            man.code(text);
            man.blocks(entry.comment);
        }
    man.section("SEE ALSO");
    man.references({"phasetreeNewTreeFromFile", "phasetreeNewGeometry", "phasetreeDecodeHit"});
}

}  // namespace

void write_man(const Reference& reference, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const auto& old : std::filesystem::directory_iterator(folder))
        if (old.path().extension() == ".3") std::filesystem::remove(old.path());
    write_overview(reference, folder);
    for (const Page& page : reference.pages) write_page(page, folder, reference.version);
}

}  // namespace phasetree::manual
