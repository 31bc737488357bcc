// The catalogue: every kind that exists, with what the studio's page needs to show and edit it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "studio/vocabulary.hpp"

namespace phasetree::tracer::studio {

/// The folder `scenes`, which has the pictures of the reference: beside the program, or in the source folder that it
/// was built in. nullopt if there is none.
std::optional<std::filesystem::path> folder_of_pictures();

/// The answer to GET /catalogue. Pictures are null without a folder. Most members of kinds and parameters correspond to
/// those of CatalogueKind and KindParameter; kind_json() and parameter_json() in catalogue.cpp list all of them. These
/// are not obvious:
///   * of a kind, "kind": its name; "help": the summary, equation and section; "keyed": is_written_with_name (in the
///     outline of a document, "keyed" means "changes with time"); "alone": the name of lone_parameter(); "slots": the
///     parameters whose control is "slot"; "parameters": all others;
///   * of a parameter, "instead": the slot type whose values may replace its plain value.
std::string written_catalogue(const Vocabulary& vocabulary, const std::optional<std::filesystem::path>& pictures);

/// The file of a picture of the catalogue, such as "nodes/fields/sphere.jpg". nullopt for any other name.
std::optional<std::filesystem::path> picture_file(const Vocabulary& vocabulary, const std::filesystem::path& folder,
                                                  std::string_view name);

}  // namespace phasetree::tracer::studio
