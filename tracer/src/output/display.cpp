#include "output/display.hpp"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "output/default_config.hpp"
#include "output/error.hpp"
#include "phasetree/math/portable.hpp"

namespace ocio = OCIO_NAMESPACE;

namespace phasetree::tracer {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

// The number of typing mistakes between two words: the minimum number of insertions, deletions, substitutions and swaps
// of adjacent characters (optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> above(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::vector<std::size_t> next(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) next[j] = std::min(next[j], above[j - 2] + 1);
        }
        std::swap(above, row);
        std::swap(row, next);
    }
    return row[b.size()];
}

std::string quoted_list(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
    return list;
}

// Finds a display or view, and returns its spelling in the configuration. Case is ignored, as in OpenColorIO.
std::string choose(const std::string& wanted, const std::vector<std::string>& names, const std::string& what,
                   const std::string& of_what = "") {
    std::string nearest;
    std::size_t best = std::string::npos;
    for (const std::string& name : names) {
        if (lower(name) == lower(wanted)) return name;
        const std::size_t distance = lower(name).find(lower(wanted)) != std::string::npos && !wanted.empty()
                                         ? 1
                                         : edit_distance(lower(wanted), lower(name));
        if (distance < best) {
            best = distance;
            nearest = name;
        }
    }
    // Up to a third of the letters may be wrong in a typing mistake; beyond that, it is another word.
    const bool likely = best != std::string::npos && 3 * best <= std::max<std::size_t>(wanted.size(), 3);
    throw DisplayError(fmt::format("unknown {} \"{}\"{}{}; choose from {}", what, wanted, of_what,
                                   likely ? fmt::format(" (did you mean \"{}\"?)", nearest) : "", quoted_list(names)));
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text;
}

struct NamedConfig {
    ocio::ConstConfigRcPtr config;
    std::string name;  // for messages
};

ocio::ConstConfigRcPtr built_in() {
    std::istringstream text{std::string(default_color_config())};
    return ocio::Config::CreateFromStream(text);
}

NamedConfig current_config() {
    const char* path = std::getenv("OCIO");
    if (path == nullptr || *path == '\0') return {built_in(), "the built-in OpenColorIO configuration"};
    const auto refuse = [path](const std::string& reason) {
        return DisplayError(
            fmt::format("cannot read the OpenColorIO configuration \"{}\", named by $OCIO: {} (correct the path, or "
                        "unset OCIO to use the built-in configuration)",
                        path, reason));
    };
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw refuse("it is a directory");
    try {
        return {ocio::Config::CreateFromEnv(), fmt::format("the OpenColorIO configuration \"{}\"", path)};
    } catch (const std::bad_alloc&) {
        throw;  // unrelated to the configuration
    } catch (const std::exception& error) {
        throw refuse(one_line(error.what()));
    }
}

// Linear Rec.709 to ACES2065-1, by OpenColorIO's own matrices.
ocio::ConstTransformRcPtr rec709_to_aces() {
    const auto rec709_to_ap1 = ocio::BuiltinTransform::Create();
    rec709_to_ap1->setStyle("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD");
    rec709_to_ap1->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    const auto ap1_to_ap0 = ocio::BuiltinTransform::Create();
    ap1_to_ap0->setStyle("ACEScg_to_ACES2065-1");
    const auto both = ocio::GroupTransform::Create();
    both->appendTransform(rec709_to_ap1);
    both->appendTransform(ap1_to_ap0);
    return both;
}

// The colour space of the pixels, linear Rec.709, in any configuration, which need not have it or use that name. Tries
// its usual names first, then goes through ACES2065-1, which version 2 configurations identify by a role. Version 1 has
// no such role; in its configurations without one of the names, scene_linear is linear Rec.709.
struct Source {
    std::string color_space;
    bool over_aces = false;
};

Source source_of(const ocio::ConstConfigRcPtr& config) {
    for (const char* name : {"Linear Rec.709 (sRGB)", "Linear Rec.709", "lin_rec709", "lin_rec709_srgb", "lin_srgb",
                             "Linear BT.709", "Utility - Linear - sRGB", "Utility - Linear - Rec.709", "Linear"}) {
        // getColorSpace finds aliases but also roles, and a role does not determine the primaries.
        if (!config->hasRole(name) && config->getColorSpace(name)) return {name, false};
    }
    if (config->hasRole("aces_interchange")) return {"aces_interchange", true};
    if (config->hasRole("scene_linear")) return {"scene_linear", false};
    throw DisplayError("it has neither a linear Rec.709 color space nor a role aces_interchange or scene_linear");
}

std::vector<std::string> displays_of(const ocio::ConstConfigRcPtr& config) {
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumDisplays(); ++i) names.emplace_back(config->getDisplay(i));
    return names;
}

std::vector<std::string> views_of(const ocio::ConstConfigRcPtr& config, const std::string& display) {
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumViews(display.c_str()); ++i) {
        names.emplace_back(config->getView(display.c_str(), i));
    }
    return names;
}

}  // namespace

struct DisplayTransform::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

DisplayTransform::DisplayTransform(std::optional<std::string> display, std::optional<std::string> view,
                                   float exposure_ev)
    : exposure_ev_(exposure_ev) {
    if (!std::isfinite(exposure_ev))
        throw DisplayError(fmt::format("the exposure must be a finite number of stops, but is {}", exposure_ev));
    const NamedConfig current = current_config();
    const ocio::ConstConfigRcPtr& config = current.config;
    try {
        const std::vector<std::string> displays = displays_of(config);
        if (displays.empty()) throw DisplayError("it has no display");
        display_ = display ? choose(*display, displays, "display") : config->getDefaultDisplay();
        const std::vector<std::string> views = views_of(config, display_);
        if (views.empty()) throw DisplayError(fmt::format("its display \"{}\" has no view", display_));
        view_ = view ? choose(*view, views, "view", fmt::format(" of display \"{}\"", display_))
                     : config->getDefaultView(display_.c_str());

        const Source source = source_of(config);
        const auto chain = ocio::GroupTransform::Create();
        if (source.over_aces) chain->appendTransform(rec709_to_aces()->createEditableCopy());
        const auto to_view = ocio::DisplayViewTransform::Create();
        to_view->setSrc(source.color_space.c_str());
        to_view->setDisplay(display_.c_str());
        to_view->setView(view_.c_str());
        chain->appendTransform(to_view);

        // All optimisations except approximate logarithms and powers. A picture is converted once, so exact curves are
        // affordable.
        constexpr auto flags =
            static_cast<ocio::OptimizationFlags>(ocio::OPTIMIZATION_DEFAULT & ~ocio::OPTIMIZATION_FAST_LOG_EXP_POW);
        const auto processor = config->getProcessor(chain, ocio::TRANSFORM_DIR_FORWARD);
        processor_ = std::make_shared<const Processor>(Processor{processor->getOptimizedCPUProcessor(flags)});
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const DisplayError& error) {
        throw DisplayError(fmt::format("{}: {}", current.name, error.what()));
    } catch (const std::exception& error) {  // including ocio::Exception
        throw DisplayError(fmt::format("{}: {}", current.name, one_line(error.what())));
    }
}

void DisplayTransform::apply(std::span<glm::vec3> pixels) const {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "pixels are handed to OpenColorIO as packed floats");
    if (pixels.empty()) return;
    // The largest half-precision number, far beyond any display. Lookup tables for half-precision input end there, and
    // values that overflow inside a transform come out black or as NaN.
    constexpr float largest = 65504.0f;
    const float gain = portable::exp2(exposure_ev_);
    for (glm::vec3& pixel : pixels) {
        const bool finite = std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b);
        for (int c = 0; c < 3; ++c) {
            // An exposure of +200 EV makes gain overflow; 0 · ∞ would be NaN.
            const float exposed = finite && pixel[c] != 0.0f ? pixel[c] * gain : 0.0f;
            pixel[c] = std::clamp(exposed, -largest, largest);
        }
    }
    ocio::PackedImageDesc description(pixels.data(), static_cast<long>(pixels.size()), 1, 3);
    processor_->cpu->apply(description);
}

bool DisplayTransform::is_srgb() const {
    return lower(display_).find("srgb") != std::string::npos;
}

std::string opencolorio_version() {
    return ocio::GetVersion();
}

}  // namespace phasetree::tracer
