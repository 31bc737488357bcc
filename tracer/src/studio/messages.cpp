#include "studio/messages.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "phasetree/io/object_reader.hpp"
#include "phasetree/io/suggest.hpp"
#include "studio/layout.hpp"
#include "studio/outline.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::studio {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_text_of_parameter = 2000;

// Formats JSON as one line. In strings that are not UTF-8, such as those of other programs, the invalid bytes become
// replacement characters.
std::string line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json maybe(const std::optional<std::string>& text) {
    return text ? Json(*text) : Json();
}

// A member that is a JSON pointer.
std::string read_pointer(ObjectReader& reader, const char* key) {
    auto pointer = reader.required<std::string>(key);
    try {
        (void)pointer_tokens(pointer);
    } catch (const std::invalid_argument& e) {
        throw reader.document().error(reader.required_value(key), e.what());
    }
    return pointer;
}

Operation read_operation(ObjectReader& reader) {
    if (reader.value("set")) return SetValue{read_pointer(reader, "set"), reader.required<std::string>("to")};
    if (reader.value("insert"))
        return InsertValue{read_pointer(reader, "insert"), reader.required<std::string>("value")};
    if (reader.value("remove")) return RemoveValue{read_pointer(reader, "remove")};
    if (reader.value("move")) return MoveValue{read_pointer(reader, "move"), read_pointer(reader, "to")};
    if (reader.value("wrap")) return WrapValue{read_pointer(reader, "wrap"), reader.required<std::string>("in")};
    if (reader.value("unwrap")) return UnwrapValue{read_pointer(reader, "unwrap"), read_pointer(reader, "keep")};
    if (reader.value("rename"))
        return RenameKey{read_pointer(reader, "rename"), reader.required<std::string>("to"),
                         reader.optional<bool>("references", false)};
    if (reader.value("text")) return ReplaceText{reader.required<std::string>("text")};
    throw reader.document().error(
        reader.object(),
        "an operation must be \"set\", \"insert\", \"remove\", \"move\", \"wrap\", \"unwrap\", \"rename\" or \"text\"");
}

// The line numbers of offsets in a text. Fast if the offsets are queried in increasing order.
class Lines {
  public:
    explicit Lines(const std::string& text) : text_(text) {}

    std::size_t line_of(std::size_t offset) {
        if (offset < counted_) {
            counted_ = 0;
            line_ = 1;
        }
        for (; counted_ < offset; ++counted_)
            if (text_[counted_] == '\n' || (text_[counted_] == '\r' && text_[counted_ + 1] != '\n')) ++line_;
        return line_;
    }

  private:
    const std::string& text_;
    std::size_t counted_ = 0, line_ = 1;
};

class OutlineWriter {
  public:
    explicit OutlineWriter(const Document& document) : document_(document), lines_(document.text()) {}

    Json entry(const OutlineEntry& e) {
        Json json;
        json["pointer"] = e.pointer;
        json["kind"] = e.kind;
        json["chapter"] = e.of ? Json(e.of->chapter) : Json();
        json["type"] = e.type;
        json["label"] = maybe(e.label);
        json["slot"] = maybe(e.slot);
        json["phases"] = e.phases;
        json["line"] = e.value ? lines_.line_of(e.value->offset()) : 1;
        json["parameters"] = Json::object();
        for (const OutlineParameter& p : e.parameters) json["parameters"][p.name] = parameter(p);
        json["slots"] = Json::array();
        if (e.of)
            for (const KindParameter& p : e.of->parameters)
                if (p.slot)
                    json["slots"].push_back({{"name", p.name}, {"list", p.slot->is_list}, {"type", p.slot->type}});
        json["children"] = Json::array();
        for (const OutlineEntry& child : e.children) json["children"].push_back(entry(child));
        return json;
    }

  private:
    Json parameter(const OutlineParameter& p) const {
        const Span span = span_of(document_, *p.value);
        Json json{{"pointer", p.pointer}, {"text", Json()}, {"keyed", p.is_keyed}};
        if (span.size() <= longest_text_of_parameter) json["text"] = std::string(span.of(document_.text()));
        if (!p.is_known) json["known"] = false;
        return json;
    }

    const Document& document_;
    Lines lines_;
};

Json error_json(const SceneError& error, const std::string& file) {
    std::string message = error.message();
    if (error.suggestion()) message += fmt::format(" (did you mean \"{}\"?)", *error.suggestion());
    Json json{{"message", message}, {"line", Json()}, {"column", Json()}};
    if (error.file() != file) {
        json["message"] = error.line() > 0
                              ? fmt::format("{}:{}:{}: {}", error.file(), error.line(), error.column(), message)
                              : fmt::format("{}: {}", error.file(), message);
    } else if (error.line() > 0) {
        json["line"] = error.line();
        json["column"] = error.column();
    }
    return json;
}

void write_text_and_outline(const DocumentState& state, const Vocabulary& vocabulary, Json& json) {
    // Pages do not edit texts that are larger than operations accept.
    const bool is_too_large = state.text->size() > EditedDocument::most_bytes_of_text;
    json["text"] = is_too_large ? Json() : Json(*state.text);
    json["too_large"] = is_too_large;
    json["outline"] = Json();
    json["outline_has_more"] = false;
    if (!state.document || is_too_large) return;
    const Outline outline = outline_of(*state.document, vocabulary, Outline::most_on_a_page);
    OutlineWriter writer(*state.document);
    json["outline"] = Json::array();
    for (const OutlineEntry& entry : outline.entries) json["outline"].push_back(writer.entry(entry));
    json["outline_has_more"] = outline.has_more;
}

}  // namespace

EditRequest read_edit_request(const std::string& text) {
    const Document document = Document::from_text(text, "<request>");
    ObjectReader reader(document, document.root(), "the request");
    EditRequest request;
    request.base = static_cast<std::uint64_t>(reader.required<double>("base", {0, 9e15}));
    request.label = reader.required<std::string>("label");
    if (request.label.size() > 200)
        throw document.error(reader.required_value("label"), "\"label\" is longer than 200 bytes");
    if (const auto merge = reader.value("merge"); merge && !merge->is_null()) {
        request.merge = as<std::string>(document, *merge, "\"merge\"");
        if (request.merge->size() > 200) throw document.error(*merge, "\"merge\" is longer than 200 bytes");
    }
    request.is_strict = reader.optional<bool>("strict", false);
    const Value operations = reader.required_value("operations");
    if (!operations.is_array()) throw document.error(operations, "\"operations\" must be a list");
    if (operations.size() > EditedDocument::most_operations)
        throw document.error(operations,
                             fmt::format("a request may have at most {} operations", EditedDocument::most_operations));
    reader.finish();
    for (const Value operation : operations) {
        ObjectReader one(document, operation, "the operation");
        request.operations.push_back(read_operation(one));
        one.finish();
    }
    return request;
}

std::string written(const DocumentState& state, const EditedDocument& of, std::uint64_t known) {
    Json json;
    json["version"] = state.version;
    json["text_version"] = state.text_version;
    if (state.text_version != known) write_text_and_outline(state, of.vocabulary(), json);
    const std::optional<SceneError>& error = state.unreadable ? state.unreadable : state.error;
    json["error"] = error ? error_json(*error, of.file().string()) : Json();
    json["checked"] = state.is_checked;
    json["undo"] = maybe(state.undo);
    json["redo"] = maybe(state.redo);
    json["saved"] = state.is_saved;
    json["save_error"] = state.save_error.empty() ? Json() : Json(state.save_error);
    json["file"] = of.file().filename().string();
    return line(json);
}

std::string written(const SceneError& error, const std::string& file) {
    return line(Json{{"error", error_json(error, file)}});
}

std::string written_version(std::uint64_t version) {
    return fmt::format("{{\"version\": {}}}", version);
}

}  // namespace phasetree::tracer::studio
