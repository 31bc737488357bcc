#include "reference/header.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>

#include "reference/text.hpp"

namespace phasetree::manual {

namespace {

class Reader {
  public:
    Reader(std::string file, const std::string& text) : text_(text) { header_.file = std::move(file); }

    Header read() {
        while (at_ < text_.size()) {
            if (text_[at_] == '\n') {
                ++at_;
                between();
            } else if (text_.compare(at_, 2, "/*") == 0) {
                comment();
            } else if (text_[at_] == '#') {
                directive();
            } else {
                declaration();
            }
        }
        return std::move(header_);
    }

  private:
    // Behind an empty line a comment is nobody's, and declarations are no longer one another's.
    void between() {
        comment_.clear();
        together_ = false;
    }

    int line() const { return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + position(at_), '\n')); }

    [[noreturn]] void fail(const std::string& what) const {
        throw HeaderError(header_.file + ":" + std::to_string(begun_at_) + ": " + what);
    }

    static std::ptrdiff_t position(std::size_t at) { return static_cast<std::ptrdiff_t>(at); }

    // Everything up to `end`, which is passed.
    std::string up_to(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        if (found == std::string::npos) fail("this has no end");
        const std::string passed = text_.substr(at_, found + end.size() - at_);
        at_ = found + end.size();
        return passed;
    }

    void rest_of_line() {
        if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    }

    void comment() {
        const bool is_first = at_ == 0;
        begun_at_ = line();
        comment_ = blocks_of(up_to("*/"));
        together_ = false;
        rest_of_line();
        if (is_first) header_.comment = std::move(comment_), comment_.clear();
    }

    void directive() {
        begun_at_ = this->line();
        std::string line = up_to("\n");
        while (line.ends_with("\\\n")) line += up_to("\n");
        if (line.starts_with("#if defined(__cplusplus)")) {
            up_to("#endif");
            rest_of_line();
            return;
        }
        static const std::regex inclusion(R"re(^#include "phasetree/embree/(\w+\.h)")re");
        static const std::regex constant(R"(^#define (PHASETREE_\w+)[ (]\S)");
        std::smatch match;
        if (std::regex_search(line, match, inclusion)) header_.includes.push_back(match[1]);
        if (!std::regex_search(line, match, constant) || match[1] == "PHASETREE_API") return;
        add({Kind::macro, match[1], trimmed(line), {}, {}});
    }

    // Up to the semicolon outside of braces and parentheses, or a function's closing brace.
    void declaration() {
        const std::size_t from = at_;
        begun_at_ = line();
        int depth = 0;
        const auto is_function = [&] { return !text_.substr(from, at_ - from).starts_with("typedef"); };
        for (;; ++at_) {
            if (at_ == text_.size()) fail("this declaration has no end");
            if (text_.compare(at_, 2, "/*") == 0) {
                up_to("*/");
                --at_;
                continue;
            }
            const char c = text_[at_];
            depth += (c == '{' || c == '(') - (c == '}' || c == ')');
            if (depth == 0 && (c == ';' || (c == '}' && is_function()))) break;
        }
        ++at_;
        const std::string text = text_.substr(from, at_ - from);
        rest_of_line();
        add(is_type(text) ? type(text) : function(text));
    }

    static bool is_type(const std::string& text) { return text.starts_with("typedef"); }

    Declaration type(const std::string& text) const {
        static const std::regex name(R"((?:\(\*(\w+)\)\([^;]*|(\w+));$)");
        std::smatch match;
        if (!std::regex_search(text, match, name)) fail("this type has no name at its end");
        const bool has_body = text.find('{') != std::string::npos;
        const Kind kind = !has_body                          ? Kind::type
                          : text.starts_with("typedef enum") ? Kind::enumeration
                                                             : Kind::structure;
        return {kind, match.str(1) + match.str(2), text, {}, {}};
    }

    Declaration function(const std::string& text) const {
        static const std::regex form(R"(^(?:PHASETREE_API |static inline )?(.*?)(\w+)\((.*?)\)(?:;$| \{))");
        static const std::regex parameter_name(R"(\(\*(\w+)\)|(\w+)(?:\[\w*\])?$)");
        const std::string flat = std::regex_replace(text, std::regex(R"(\s+)"), " ");
        std::smatch match;
        if (!std::regex_search(flat, match, form)) fail("this is no declaration of a function");
        Declaration found{Kind::function, match[2], {}, trimmed(match.str(1)), {}};
        found.text = match.str(1) + match.str(2) + "(" + match.str(3) + ");";
        if (match[3] == "void") return found;
        for (const std::string& parameter : split_parameters(match.str(3))) {
            std::smatch word;
            if (!std::regex_search(parameter, word, parameter_name)) fail("a parameter has no name");
            found.parameters.push_back(word.str(1) + word.str(2));
        }
        return found;
    }

    void add(Declaration declaration) {
        if (!together_) {
            header_.entries.push_back({{}, std::move(comment_), begun_at_});
            comment_.clear();
        }
        header_.entries.back().declarations.push_back(std::move(declaration));
        together_ = true;
    }

    const std::string& text_;
    std::size_t at_ = 0;
    Header header_;
    std::vector<Block> comment_;  // the last one, until it has found its declaration
    int begun_at_ = 0;            // the line where what is being read begins
    bool together_ = false;       // the next declaration has the last one's comment
};

}  // namespace

Header read_header(const std::filesystem::path& path) {
    std::ifstream file(path);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file) throw HeaderError(path.string() + " cannot be read");
    return Reader(path.filename().string(), text).read();
}

}  // namespace phasetree::manual
