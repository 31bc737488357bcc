#include "reference/markup.hpp"

#include <regex>

namespace phasetree::manual {

std::vector<Span> spans_of(const std::string& text) {
    static const std::regex mark(
        R"(`([^`]+)`|\*([^* ](?:[^*]*[^* ])?)\*|\b((?:[Pp]hasetree[A-Z]|PHASETREE_|rtc[A-Z]|RTC)\w*))");
    std::vector<Span> spans;
    auto from = text.begin();
    for (std::sregex_iterator i(text.begin(), text.end(), mark), last; i != last; ++i) {
        const std::smatch& match = *i;
        if (match[0].first != from) spans.push_back({Style::plain, std::string(from, match[0].first)});
        if (match[1].matched)
            spans.push_back({Style::code, match[1]});
        else if (match[2].matched)
            spans.push_back({Style::emphasis, match[2]});
        else
            spans.push_back({Style::name, match[3]});
        from = match[0].second;
    }
    if (from != text.end()) spans.push_back({Style::plain, std::string(from, text.end())});
    return spans;
}

std::string plain(const std::string& text) {
    std::string bare;
    for (const Span& span : spans_of(text)) bare += span.text;
    return bare;
}

}  // namespace phasetree::manual
