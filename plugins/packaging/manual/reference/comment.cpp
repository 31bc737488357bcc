#include "reference/comment.hpp"

#include <optional>
#include <regex>

#include "reference/text.hpp"

namespace phasetree::manual {

namespace {

// The comment's lines without its marks; their indentation is left.
std::vector<std::string> lines_of(std::string_view comment) {
    static const std::regex mark(R"(^ *\* ?)");
    comment.remove_prefix(2);
    comment.remove_suffix(2);
    std::vector<std::string> lines;
    for (const std::string& line : split(comment, '\n')) {
        const std::string bare = lines.empty() ? trimmed(line) : std::regex_replace(line, mark, "");
        lines.push_back(bare.substr(0, bare.find_last_not_of(' ') + 1));
    }
    return lines;
}

struct DefinitionLine {
    std::size_t indentation;
    Definition definition;
};

std::optional<DefinitionLine> definition_of(const std::string& line) {
    static const std::regex form(R"(^( *)([A-Za-z_][\w.]*(?:, [A-Za-z_][\w.]*)*)  +(\S.*)$)");
    std::smatch match;
    if (!std::regex_match(line, match, form)) return std::nullopt;
    DefinitionLine found{static_cast<std::size_t>(match.length(1)), {{}, match.str(3)}};
    for (const std::string& term : split(match.str(2), ',')) found.definition.terms.push_back(trimmed(term));
    return found;
}

void append(std::string& text, const std::string& line) {
    if (!text.empty()) text += ' ';
    text += trimmed(line);
}

}  // namespace

std::vector<Block> blocks_of(std::string_view comment) {
    std::vector<Block> blocks;
    bool goes_on = false;         // the last block
    std::size_t indentation = 0;  // of its last definition, if it is a list
    for (const std::string& line : lines_of(comment)) {
        const std::size_t text = line.find_first_not_of(' ');
        const bool in_list = goes_on && !blocks.back().definitions.empty();
        if (text == std::string::npos) {
            goes_on = false;
        } else if (const auto found = definition_of(line)) {
            if (!in_list) blocks.emplace_back();
            blocks.back().definitions.push_back(found->definition);
            indentation = found->indentation;
            goes_on = true;
        } else if (in_list && text > indentation) {
            append(blocks.back().definitions.back().text, line);
        } else {
            if (!goes_on || in_list) blocks.emplace_back();
            append(blocks.back().text, line);
            goes_on = true;
        }
    }
    return blocks;
}

std::vector<std::string> sentences_of(const std::string& text) {
    static const std::regex end(R"(([.!?])\)? +(?=[A-Z0-9Φ"*`(]|[a-z]+[A-Z]))");
    std::vector<std::string> sentences;
    auto from = text.begin();
    for (std::sregex_iterator i(text.begin(), text.end(), end), last; i != last; ++i) {
        const auto to = (*i)[1].second;
        sentences.push_back(trimmed(std::string(from, to)));
        from = to;
    }
    if (from != text.end()) sentences.push_back(trimmed(std::string(from, text.end())));
    return sentences;
}

std::string summary_of(const std::vector<Block>& blocks) {
    if (blocks.empty() || blocks.front().text.empty()) return {};
    std::string first = sentences_of(blocks.front().text).front();
    constexpr std::size_t least = 20;  // so short a beginning says nothing alone
    int depth = 0;                     // of parentheses
    for (std::size_t i = 0; i < first.size(); ++i) {
        depth += (first[i] == '(') - (first[i] == ')');
        if (depth == 0 && i >= least && (first[i] == ';' || first[i] == ':') && i + 1 < first.size() &&
            first[i + 1] == ' ') {
            first.resize(i);
            break;
        }
    }
    while (!first.empty() && (first.back() == '.' || first.back() == ':')) first.pop_back();
    return first;
}

}  // namespace phasetree::manual
