// Answers the requests of the studio: the document, its history and the catalogue.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "studio/edited_document.hpp"

namespace phasetree::tracer::view {

class StudioAnswers {
  public:
    static constexpr std::array<std::string_view, 4> posted{"document", "undo", "redo", "save"};

    explicit StudioAnswers(studio::EditedDocument& document);

    static bool is_posted(std::string_view name);
    static bool is_answered(std::string_view name);
    /// What the page has already: versions of the document (DocumentState), or 0.
    struct Known {
        std::uint64_t version = 0, text_version = 0;
    };
    /// Returns false if there is no such page.
    bool get(std::string_view name, Known known, std::chrono::milliseconds timeout, httplib::Response& response) const;
    /// The files beside the scene that a kind of node, light, … can read; see studio::files_for.
    void files(const std::string& type, const std::string& kind, httplib::Response& response) const;
    void post(std::string_view name, const std::string& body, httplib::Response& response) const;

  private:
    studio::EditedDocument& document_;
    std::optional<std::filesystem::path> pictures_;
    std::string catalogue_;
};

}  // namespace phasetree::tracer::view
