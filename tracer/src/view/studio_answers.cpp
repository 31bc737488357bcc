#include "view/studio_answers.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "output/error.hpp"
#include "studio/catalogue.hpp"
#include "studio/messages.hpp"
#include "studio/scene_files.hpp"
#include "studio/starts.hpp"

namespace phasetree::tracer::view {

namespace {

constexpr const char* type_of_answers = "application/json";
constexpr std::string_view pictures_path = "pictures/";

// The scenes of `phasetree new`.
std::string written_starts() {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const studio::StartFile& start : studio::start_files())
        json.push_back({{"name", start.stem()}, {"summary", start.summary()}, {"text", start.text}});
    return json.dump();
}

void refuse(httplib::Response& response, int status, const SceneError& error, const std::string& file) {
    response.status = status;
    response.set_content(studio::written(error, file), type_of_answers);
}

}  // namespace

StudioAnswers::StudioAnswers(studio::EditedDocument& document)
    : document_(document),
      pictures_(studio::folder_of_pictures()),
      catalogue_(studio::written_catalogue(document.vocabulary(), pictures_)) {}

bool StudioAnswers::is_posted(std::string_view name) {
    return std::ranges::find(posted, name) != posted.end();
}

bool StudioAnswers::is_answered(std::string_view name) {
    return name == "document" || name == "catalogue" || name == "starts" || name.starts_with(pictures_path);
}

bool StudioAnswers::get(std::string_view name, Known known, std::chrono::milliseconds timeout,
                        httplib::Response& response) const {
    if (name == "document") {
        const auto state = document_.state_after(known.version, timeout);
        response.set_content(studio::written(*state, document_, known.text_version), type_of_answers);
        return true;
    }
    if (name == "catalogue") {
        response.set_content(catalogue_, type_of_answers);
        return true;
    }
    if (name == "starts") {
        response.set_content(written_starts(), type_of_answers);
        return true;
    }
    if (!pictures_) return false;
    const auto file = studio::picture_file(document_.vocabulary(), *pictures_, name.substr(pictures_path.size()));
    if (!file) return false;
    std::ifstream in(*file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || bytes.empty()) return false;
    response.set_content(std::move(bytes), "image/jpeg");
    return true;
}

void StudioAnswers::files(const std::string& type, const std::string& kind, httplib::Response& response) const {
    const studio::SceneFiles found = studio::files_for(document_.file(), type, kind);
    const nlohmann::json json{{"names", found.names}, {"has_more", found.has_more}};
    // File names may contain any bytes, not only UTF-8.
    response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), type_of_answers);
}

void StudioAnswers::post(std::string_view name, const std::string& body, httplib::Response& response) const {
    const std::string file = document_.file().string();
    try {
        std::uint64_t version = 0;
        if (name == "document")
            version = document_.edit(studio::read_edit_request(body));
        else if (name == "undo")
            version = document_.undo();
        else if (name == "redo")
            version = document_.redo();
        else
            version = document_.save();
        response.set_content(studio::written_version(version), type_of_answers);
    } catch (const studio::ConflictError& e) {
        refuse(response, 409, SceneError(file, e.what()), file);
    } catch (const OutputError& e) {
        refuse(response, 409, SceneError(file, e.what()), file);
    } catch (const SceneError& e) {
        refuse(response, 400, e, file);
    }
}

}  // namespace phasetree::tracer::view
