// nlohmann-json parses the text; its SAX events become the flat array of DocumentData. Events carry no position, but
// the parser reads its input byte by byte through an iterator that tracks the position. An event immediately follows
// its token, so the position is the token's end. (A number is read one byte too far, so its end is determined by its
// own grammar.) The token's start is what follows the white space, comments, commas and colons after the previous
// token.

#include "io/json/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "io/json/diagnose.hpp"
#include "io/json/lexis.hpp"
#include "io/json/utf8.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

namespace {

// The text as seen by the parser: each run of white space and comments is a single space. The parser could skip them
// itself. But it stores everything read since the last string or number for its own error message, which nobody sees,
// at a cost of a microsecond per line end.
class Source {
  public:
    explicit Source(std::string_view text) : text_(text) {}

    std::size_t reached() const { return at_; }
    bool is_at_end() const { return at_ == text_.size(); }

    char current() const {
        const char c = text_[at_];
        if (state_ != State::between || !may_be_blank(c)) return c;
        // A slash that does not begin a complete comment becomes a byte that is invalid everywhere.
        return skip_blank(text_, at_) > at_ ? ' ' : '\x01';
    }

    void advance() {
        const char c = text_[at_];
        const std::size_t next = state_ == State::between && may_be_blank(c) ? skip_blank(text_, at_) : at_ + 1;
        at_ = std::max(next, at_ + 1);
        switch (state_) {
            case State::between:
                state_ = c == '"' ? State::string : State::between;
                break;
            case State::string:
                state_ = c == '"' ? State::between : c == '\\' ? State::escape : State::string;
                break;
            case State::escape:
                state_ = State::string;
                break;
        }
    }

  private:
    enum class State { between, string, escape };

    static bool may_be_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '/'; }

    std::string_view text_;
    std::size_t at_ = 0;
    State state_ = State::between;
};

// Reads a Source. A default-constructed one is the end.
class SourceIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = char;

    SourceIterator() = default;
    explicit SourceIterator(Source& source) : source_(&source) {}
    char operator*() const { return source_->current(); }
    SourceIterator& operator++() {
        source_->advance();
        return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(const SourceIterator& other) const { return is_end() == other.is_end(); }

  private:
    bool is_end() const { return source_ == nullptr || source_->is_at_end(); }

    Source* source_ = nullptr;
};

class Builder {
  public:
    using Entry = DocumentData::Entry;

    explicit Builder(DocumentData& data) : data_(data), source_(data.text) {}

    // Throws SceneError if the text is invalid.
    void run() {
        const bool is_good = nlohmann::json::sax_parse(SourceIterator(source_), SourceIterator(), this);
        if (!is_good) throw diagnose(data_.name, data_.text, failure_);
        place_.finished(data_.text.size());
        data_.root = append(pending_);
    }

    // The events of nlohmann::json_sax. Returning `false` stops the parser.

    bool null() { return word(Kind::null, {.number = 0}); }
    bool boolean(bool value) { return word(Kind::boolean, {.boolean = value}); }
    bool number_integer(std::int64_t value) { return number(static_cast<double>(value)); }
    bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value)); }
    bool number_float(double value, const std::string&) { return number(value); }

    bool string(std::string& value) {
        if (value.find('\0') != std::string::npos) return false;
        const std::size_t begin = next_token();
        const DocumentData::Span stored = store(value);
        add(Kind::string, {.span = stored}, begin);
        behind_value(begin, reached());
        return true;
    }

    bool key(std::string& value) {
        if (value.find('\0') != std::string::npos) return false;
        const std::size_t begin = next_token();
        key_ = static_cast<std::uint32_t>(data_.keys.size());
        data_.keys.push_back({store(value), static_cast<std::uint32_t>(begin)});
        passed(begin, reached(), Expecting::colon);
        return true;
    }

    bool start_object(std::size_t) { return open(Kind::object); }
    bool start_array(std::size_t) { return open(Kind::array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool binary(nlohmann::json::binary_t&) { return false; }  // only in binary formats
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) { return false; }

  private:
    union Payload {
        double number;
        bool boolean;
        DocumentData::Span span;
    };

    struct Open {
        std::size_t begin;
        std::size_t first_pending;
        std::uint32_t key;
        Kind kind;
    };

    std::size_t reached() const { return source_.reached(); }
    std::size_t next_token() const { return skip_to_token(data_.text, failure_.last_token_end); }

    DocumentData::Span store(std::string_view string) {
        const auto first = static_cast<std::uint32_t>(data_.strings.size());
        data_.strings += string;
        return {first, static_cast<std::uint32_t>(string.size())};
    }

    void add(Kind kind, Payload payload, std::size_t begin) {
        Entry entry;
        switch (kind) {
            case Kind::number:
                entry.number = payload.number;
                break;
            case Kind::boolean:
                entry.boolean = payload.boolean;
                break;
            case Kind::null:
                entry.number = 0;
                break;
            case Kind::string:
            case Kind::array:
            case Kind::object:
                entry.span = payload.span;
                break;
        }
        entry.offset = static_cast<std::uint32_t>(begin) & (Document::max_bytes - 1);
        entry.kind = static_cast<unsigned>(kind) & 15u;
        entry.key = std::exchange(key_, DocumentData::no_key);
        pending_.push_back(entry);
    }

    bool word(Kind kind, Payload payload) {
        const std::size_t begin = next_token();
        add(kind, payload, begin);
        behind_value(begin, reached());
        failure_.last_is_word = true;
        return true;
    }

    bool number(double value) {
        const std::size_t begin = next_token();
        add(Kind::number, {.number = value}, begin);
        behind_value(begin, number_end(data_.text, begin));
        failure_.last_is_word = true;
        return true;
    }

    bool open(Kind kind) {
        const std::size_t begin = next_token();
        if (open_.size() == Document::max_depth) {
            throw SceneError(data_.name, data_.text, begin,
                             fmt::format("nested deeper than {} levels", Document::max_depth));
        }
        open_.push_back({begin, pending_.size(), std::exchange(key_, DocumentData::no_key), kind});
        passed(begin, begin + 1, kind == Kind::object ? Expecting::first_key : Expecting::first_item);
        return true;
    }

    bool close() {
        const Open opened = open_.back();
        open_.pop_back();
        const std::span<const Entry> children = std::span(pending_).subspan(opened.first_pending);
        const auto count = static_cast<std::uint32_t>(children.size());
        const std::uint32_t first = append(children);
        pending_.resize(opened.first_pending);
        if (opened.kind == Kind::object) check_keys(first, count);

        key_ = opened.key;
        add(opened.kind, {.span = {first, count}}, opened.begin);
        behind_value(reached() - 1, reached());
        return true;
    }

    std::uint32_t append(std::span<const Entry> entries) {
        const auto first = static_cast<std::uint32_t>(data_.values.size());
        data_.values.insert(data_.values.end(), entries.begin(), entries.end());
        return first;
    }

    void check_keys(std::uint32_t first, std::uint32_t count) {
        const auto key = [&](std::uint32_t i) { return data_.key_of(data_.values[i]); };
        // Report the first duplicate in the text.
        std::uint32_t repeated = first + count;
        std::uint32_t original = 0;
        const auto compare = [&](std::uint32_t earlier, std::uint32_t later) {
            if (later < repeated && key(earlier) == key(later)) {
                repeated = later;
                original = earlier;
            }
        };
        if (count <= DocumentData::wide) {
            for (std::uint32_t later = first + 1; later < first + count; ++later) {
                for (std::uint32_t earlier = first; earlier < later; ++earlier) compare(earlier, later);
            }
        } else {
            const std::size_t begin = data_.by_key.size();
            data_.indices.push_back({first, static_cast<std::uint32_t>(begin)});
            data_.by_key.resize(begin + count);
            const std::span<std::uint32_t> sorted = std::span(data_.by_key).subspan(begin);
            std::iota(sorted.begin(), sorted.end(), first);
            std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
                const int order = key(a).compare(key(b));
                return order != 0 ? order < 0 : a < b;
            });
            for (std::size_t i = 1; i < sorted.size(); ++i) compare(sorted[i - 1], sorted[i]);
        }
        if (repeated == first + count) return;

        const auto offset = [&](std::uint32_t i) { return data_.keys[data_.values[i].key].offset; };
        const std::size_t line = SceneError(data_.name, data_.text, offset(original), "").line();
        throw SceneError(data_.name, data_.text, offset(repeated),
                         fmt::format("the key {} is already used at line {}", in_quotes(key(repeated)), line));
    }

    void passed(std::size_t begin, std::size_t end, Expecting expecting) {
        place_.reached(end);
        failure_.last_token = begin;
        failure_.last_token_end = end;
        failure_.last_is_word = false;
        failure_.expecting = expecting;
        failure_.opened = open_.empty() ? std::nullopt : std::optional(open_.back().begin);
    }

    void behind_value(std::size_t begin, std::size_t end) {
        passed(begin, end,
               open_.empty()                       ? Expecting::end_of_file
               : open_.back().kind == Kind::object ? Expecting::next_member
                                                   : Expecting::next_item);
    }

    DocumentData& data_;
    Source source_;
    std::vector<Entry> pending_;  // the children of open arrays and objects
    std::vector<Open> open_;
    std::uint32_t key_ = DocumentData::no_key;  // of the next value
    Failure failure_;
    support::ReadingPlace place_;
};

}  // namespace

void parse(DocumentData& data) {
    const std::string_view text = data.text;
    if (text.size() > Document::max_bytes) throw SceneError(data.name, "the text is larger than 256 MiB");
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        throw SceneError(data.name, "the file is UTF-16; save it as UTF-8");
    }
    // The parser treats a zero byte as the end of the text.
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
        throw SceneError(data.name, text, zero, "a null byte: this is not UTF-8 text");
    }
    Builder(data).run();
}

}  // namespace phasetree::io
