#include <fstream>
#include <set>

#include "reference/markup.hpp"
#include "reference/write.hpp"

namespace phasetree::manual {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

class Html {
  public:
    Html(const Reference& reference, const std::filesystem::path& path) : reference_(reference), file_(path) {
        file_.exceptions(std::ios::failbit | std::ios::badbit);
        for (const Page& page : reference.pages) linked_.insert(page.names.begin(), page.names.end());
    }

    void write() {
        const std::string title = "phasetree for Embree " + reference_.version;
        file_
            << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" << title
            << "</title>\n<style>\nbody { max-width: 60em; margin: 2em auto; padding: 0 1em; font-family: sans-serif; "
               "line-height: 1.4 }\npre { background: #f4f4f4; padding: 0.7em; overflow: auto }\ndt { font-weight: "
               "bold "
               "}\n</style>\n</head>\n<body>\n<h1>"
            << title << "</h1>\n";
        contents();
        file_ << "<h2>What holds for every call</h2>\n";
        blocks(reference_.conventions);
        for (const Section& section : reference_.sections) {
            file_ << "<h2>" << escaped(section.title) << "</h2>\n";
            for (const Entry& entry : section.others) other(entry);
            for (const Page* page : section.pages) this->page(*page);
        }
        file_ << "</body>\n</html>\n";
    }

  private:
    void contents() {
        for (const Section& section : reference_.sections) {
            if (section.pages.empty()) continue;
            file_ << "<p>" << escaped(section.title) << "</p>\n<ul>\n";
            for (const Page* page : section.pages) {
                file_ << "<li>";
                for (std::size_t i = 0; i < page->names.size(); ++i) file_ << (i ? ", " : "") << prose(page->names[i]);
                file_ << ": " << prose(page->summary) << "</li>\n";
            }
            file_ << "</ul>\n";
        }
    }

    void page(const Page& page) {
        file_ << "<h3>";
        for (std::size_t i = 0; i < page.names.size(); ++i)
            file_ << (i ? ", " : "") << "<span id=\"" << page.names[i] << "\">" << page.names[i] << "</span>";
        file_ << "</h3>\n<pre>" << escaped(page.synopsis) << "</pre>\n";
        blocks(page.description);
        definitions(page.parameters);
        if (!page.result.empty()) file_ << "<h4>Returns</h4>\n";
        blocks(page.result);
        definitions(page.errors);
    }

    void other(const Entry& entry) {
        file_ << "<pre>";
        for (const Declaration& declaration : entry.declarations) file_ << escaped(declaration.text) << "\n";
        file_ << "</pre>\n";
        blocks(entry.comment);
    }

    void blocks(const std::vector<Block>& blocks) {
        for (const Block& block : blocks) {
            if (!block.text.empty()) file_ << "<p>" << prose(block.text) << "</p>\n";
            definitions(block.definitions);
        }
    }

    void definitions(const std::vector<Definition>& definitions) {
        if (definitions.empty()) return;
        file_ << "<dl>\n";
        for (const Definition& definition : definitions) {
            for (const std::string& term : definition.terms) file_ << "<dt><code>" << escaped(term) << "</code></dt>\n";
            file_ << "<dd>" << prose(definition.text) << "</dd>\n";
        }
        file_ << "</dl>\n";
    }

    std::string prose(const std::string& text) const {
        std::string out;
        for (const Span& span : spans_of(text)) {
            const std::string bare = escaped(span.text);
            switch (span.style) {
                case Style::plain:
                    out += bare;
                    break;
                case Style::emphasis:
                    out += "<em>" + bare + "</em>";
                    break;
                case Style::code:
                    out += "<code>" + bare + "</code>";
                    break;
                case Style::name:
                    out += linked_.contains(bare) ? "<a href=\"#" + bare + "\"><code>" + bare + "</code></a>"
                                                  : "<code>" + bare + "</code>";
            }
        }
        return out;
    }

    const Reference& reference_;
    std::ofstream file_;
    std::set<std::string> linked_;
};

}  // namespace

void write_html(const Reference& reference, const std::filesystem::path& file) {
    Html(reference, file).write();
}

}  // namespace phasetree::manual
