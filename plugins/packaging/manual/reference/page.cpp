#include "reference/page.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "reference/text.hpp"

namespace phasetree::manual {

namespace {

constexpr const char* error_type = "PhasetreeError";

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool has_page(const Entry& entry) {
    return std::any_of(entry.declarations.begin(), entry.declarations.end(), [](const Declaration& d) {
        return d.kind == Kind::function || d.kind == Kind::structure || d.kind == Kind::enumeration;
    });
}

// A long declaration of a function has a line for each parameter.
std::string laid_out(const Declaration& declaration) {
    constexpr std::size_t width = 78;
    if (declaration.kind != Kind::function || declaration.text.size() <= width) return declaration.text;
    const std::size_t open = declaration.text.find('(') + 1, close = declaration.text.rfind(')');
    std::string text = declaration.text.substr(0, open);
    bool is_first = true;
    for (const std::string& parameter : split_parameters(declaration.text.substr(open, close - open))) {
        text += (is_first ? "\n    " : ",\n    ") + parameter;
        is_first = false;
    }
    return text + declaration.text.substr(close);
}

// The sentences that say what is returned.
std::string returned(const std::vector<Block>& description) {
    static const std::regex word(R"(\b[Rr]eturns?\b)");
    std::string found;
    for (const Block& block : description)
        for (const std::string& sentence : sentences_of(block.text))
            if (std::regex_search(sentence, word)) found += (found.empty() ? "" : " ") + sentence;
    return found;
}

// Headers after those that they include.
std::vector<Header> in_order(std::vector<Header> headers) {
    std::vector<Header> ordered;
    while (!headers.empty()) {
        const auto next = std::find_if(headers.begin(), headers.end(), [&](const Header& header) {
            return std::none_of(headers.begin(), headers.end(),
                                [&](const Header& other) { return contains(header.includes, other.file); });
        });
        if (next == headers.end()) throw HeaderError(headers.front().file + " includes itself");
        ordered.push_back(*next);
        headers.erase(next);
    }
    return ordered;
}

// Structures' initialisers may do without a comment: they are on the page of their structure.
std::vector<Entry> with_initialisers(const std::vector<Entry>& entries) {
    std::vector<Entry> joined;
    for (const Entry& entry : entries) {
        const Declaration& first = entry.declarations.front();
        const auto initialises_last = [&] {
            const Declaration& last = joined.back().declarations.front();
            return last.kind == Kind::structure && last.name.starts_with("Phasetree") &&
                   first.name == "phasetreeInit" + last.name.substr(std::string("Phasetree").size());
        };
        if (entry.comment.empty() && !joined.empty() && initialises_last()) {
            std::vector<Declaration>& together = joined.back().declarations;
            together.insert(together.end(), entry.declarations.begin(), entry.declarations.end());
            joined.back().comment.push_back({first.name + "() sets the members' defaults.", {}});
        } else {
            joined.push_back(entry);
        }
    }
    return joined;
}

// A comment that says "as above" means the call before.
void resolve_above(Page& page, const std::string& call_before) {
    static const std::regex above(R"(\bas above\b)");
    const auto resolve = [&](std::string& text) {
        text = std::regex_replace(text, above, "as for " + call_before, std::regex_constants::format_first_only);
    };
    if (call_before.empty()) return;
    resolve(page.summary);
    for (Block& block : page.description) resolve(block.text);
    for (Definition& parameter : page.parameters) resolve(parameter.text);
}

class Writer {
  public:
    Page page(const Header& header, const Entry& entry) {
        Page page;
        page.header = header.file;
        for (const Declaration& declaration : entry.declarations) {
            page.names.push_back(declaration.name);
            page.synopsis += (page.synopsis.empty() ? "" : "\n") + laid_out(declaration);
        }
        page.summary = summary_of(entry.comment);
        where_ = header.file + ":" + std::to_string(entry.line) + ": " + page.names.front();
        if (page.summary.empty()) problem("has no description");
        sort_definitions(entry, page);
        page.result = result(entry, page);
        return page;
    }

    void finish() const {
        if (!problems_.empty()) throw HeaderError(problems_);
    }

  private:
    void problem(const std::string& what) { problems_ += (problems_.empty() ? "" : "\n") + where_ + " " + what; }

    // Lists in the comment of a function are of its parameters, of what it returns and of errors, or say something
    // else.
    void sort_definitions(const Entry& entry, Page& page) {
        std::vector<std::string> parameters;
        for (const Declaration& declaration : entry.declarations)
            parameters.insert(parameters.end(), declaration.parameters.begin(), declaration.parameters.end());
        for (const Block& block : entry.comment) {
            std::vector<Definition> others;
            bool is_of_parameters = false;
            for (const Definition& definition : block.definitions) {
                const std::string& first = definition.terms.front();
                if (std::all_of(definition.terms.begin(), definition.terms.end(),
                                [&](const std::string& term) { return contains(parameters, term); })) {
                    page.parameters.push_back(definition);
                    is_of_parameters = true;
                } else if (first == "returns") {
                    page.result.push_back({definition.text, {}});
                    char& initial = page.result.back().text.front();
                    initial = static_cast<char>(std::toupper(static_cast<unsigned char>(initial)));
                } else if (first.starts_with("PHASETREE_ERROR_")) {
                    page.errors.push_back(definition);
                } else {
                    others.push_back(definition);
                }
            }
            if (is_of_parameters)
                for (const Definition& other : others)
                    problem("describes \"" + other.terms.front() + "\", which is none of its parameters");
            if (!block.text.empty() || (!others.empty() && !is_of_parameters))
                page.description.push_back({block.text, others});
        }
    }

    std::vector<Block> result(const Entry& entry, const Page& page) {
        std::vector<Block> result = page.result;
        const auto returns = [&](auto&& test) {
            return std::any_of(entry.declarations.begin(), entry.declarations.end(),
                               [&](const Declaration& d) { return d.kind == Kind::function && test(d.result); });
        };
        if (returns([](const std::string& type) { return type == error_type; }))
            result.push_back(
                {"PHASETREE_ERROR_NONE. On failure, another PhasetreeError: nothing has changed, nothing was written "
                 "to memory behind the arguments, and phasetreeGetErrorMessage() returns the reason.",
                 {}});
        else if (returns([](const std::string& type) { return type == "void"; }))
            result.push_back({entry.declarations.front().kind == Kind::function
                                  ? "Nothing."
                                  : entry.declarations.back().name + "() returns nothing.",
                              {}});
        else if (result.empty() && returns([](const std::string&) { return true; })) {
            const std::string said = returned(page.description);
            if (said.empty()) problem("does not say what it returns (a line \"returns  …\", or a sentence)");
            result.push_back({said, {}});
        }
        return result;
    }

    std::string where_;
    std::string problems_;
};

// The names of pages that a page mentions.
std::vector<std::string> related(const Page& page, const std::set<std::string>& names) {
    static const std::regex word(R"(\w+)");
    std::string all = page.synopsis;
    const auto add = [&](const std::vector<Definition>& definitions) {
        for (const Definition& definition : definitions) all += " " + definition.text;
    };
    for (const auto* blocks : {&page.description, &page.result})
        for (const Block& block : *blocks) {
            all += " " + block.text;
            add(block.definitions);
        }
    add(page.parameters);
    add(page.errors);
    std::vector<std::string> found;
    for (std::sregex_iterator i(all.begin(), all.end(), word), last; i != last; ++i)
        if (names.contains(i->str()) && !contains(page.names, i->str()) && !contains(found, i->str()))
            found.push_back(i->str());
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

Reference reference_of(const Header& conventions, const std::vector<Header>& any_order, const std::string& version) {
    const std::vector<Header> headers = in_order(any_order);
    Reference reference{version, conventions.comment, {}, {}};
    Writer writer;
    for (const Header& header : headers) {
        std::string call_before;
        for (const Entry& entry : with_initialisers(header.entries)) {
            if (!has_page(entry)) continue;
            reference.pages.push_back(writer.page(header, entry));
            resolve_above(reference.pages.back(), call_before);
            if (entry.declarations.front().kind == Kind::function) call_before = reference.pages.back().names.front();
        }
    }
    writer.finish();

    std::set<std::string> names;
    for (const Page& page : reference.pages) names.insert(page.names.begin(), page.names.end());
    for (Page& page : reference.pages) page.related = related(page, names);
    for (const Header& header : headers) {
        Section section{header.file, summary_of(header.comment), {}, {}};
        for (const Page& page : reference.pages)
            if (page.header == header.file) section.pages.push_back(&page);
        for (const Entry& entry : header.entries)
            if (!has_page(entry)) section.others.push_back(entry);
        reference.sections.push_back(std::move(section));
    }
    return reference;
}

}  // namespace phasetree::manual
