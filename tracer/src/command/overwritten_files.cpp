#include "command/overwritten_files.hpp"

#include <fmt/format.h>

#include <set>
#include <system_error>

#include "command/errors.hpp"
#include "film/planes.hpp"
#include "output/layers.hpp"
#include "scene/named_files.hpp"

namespace phasetree::tracer {

namespace {

using std::filesystem::path;

// The absolute path without links. Also follows a last link that leads to a missing file, because writing creates that
// file. Empty if the path leads nowhere.
path destination_of(const path& file) {
    constexpr int most_links = 40;  // Linux's own limit
    std::error_code problem;
    path target = std::filesystem::absolute(file, problem);
    for (int i = 0; i < most_links && std::filesystem::is_symlink(std::filesystem::symlink_status(target, problem));
         ++i)
        target = target.parent_path() / std::filesystem::read_symlink(target, problem);
    target = std::filesystem::weakly_canonical(target, problem);
    return problem ? path() : target;
}

// The files that an output may consist of.
std::vector<path> files_of(const path& output) {
    if (!is_for_each_plane(output)) return {output};
    std::vector<path> files{file_of_plane(output, layer_of_picture)};
    for (const std::string_view plane : Planes::names) files.push_back(file_of_plane(output, std::string(plane)));
    return files;
}

bool overlaps(const path& a, const path& b) {
    for (const path& one : files_of(a))
        for (const path& other : files_of(b))
            if (is_same_file(one, other)) return true;
    return false;
}

[[noreturn]] void refuse(const NamedFile& output, const std::string& input) {
    throw UsageError(
        fmt::format("{} {} would overwrite {}; choose another file name", output.option, output.path.string(), input));
}

// Calls f with each file that a value or its members name.
template <class F>
void each_named_file(const Document& document, Value value, const F& f) {
    if (value.is_string())
        for (const path& file : named_files(document, value)) f(file);
    if (value.is_array() || value.is_object())
        for (const Value member : value) each_named_file(document, member, f);
}

}  // namespace

bool is_same_file(const path& a, const path& b) {
    std::error_code problem;
    if (std::filesystem::exists(a, problem) && !std::filesystem::is_regular_file(a, problem)) return false;
    if (std::filesystem::equivalent(a, b, problem)) return true;
    const path destination = destination_of(a);
    return !destination.empty() && destination == destination_of(b);
}

void check_overwrites(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
    for (const NamedFile& output : outputs)
        for (const NamedFile& input : inputs)
            if (overlaps(output.path, input.path))
                refuse(output, fmt::format("{} {}", input.option, input.path.string()));
    for (std::size_t i = 0; i < outputs.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (overlaps(outputs[i].path, outputs[k].path))
                throw UsageError(fmt::format("{} {} and {} {} are the same file; choose another name for one of them",
                                             outputs[k].option, outputs[k].path.string(), outputs[i].option,
                                             outputs[i].path.string()));
}

void check_overwrites(const SceneFile& scene, const Document& document, std::span<const NamedFile> outputs) {
    const NamedFile file{"the scene", scene.is_standard_input() ? "/dev/stdin" : scene.name};
    check_overwrites(std::span(&file, 1), outputs);
    std::set<path> inputs;
    each_document(document, [&](const Document& one) {
        if (&one != &document) inputs.insert(one.name());
        each_named_file(one, one.root(), [&](const path& named) { inputs.insert(named); });
    });
    for (const NamedFile& output : outputs)
        for (const path& input : inputs)
            if (overlaps(output.path, input))
                refuse(output, fmt::format("\"{}\", which the scene uses", input.string()));
}

std::vector<NamedFile> named_files_of(const std::string& option, std::span<const std::string> paths) {
    std::vector<NamedFile> files;
    for (const std::string& file : paths) files.push_back({option, file});
    return files;
}

}  // namespace phasetree::tracer
