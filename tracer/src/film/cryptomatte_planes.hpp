// Cryptomatte layers (cryptomatte.hpp): the named things that are visible in a pixel, and the coverage of each.
// Coverage is measured by samples, so edges are as soft as the pixel filter makes them. Glass covers what is behind it.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>

#include "film/contract.hpp"
#include "film/cryptomatte.hpp"
#include "film/path_record.hpp"
#include "film/sums/weights_by_id.hpp"

namespace phasetree::tracer {

/// `What` provides names(scene_names), and shown(surface, number of phases): the index of the surface's name among
/// these names.
template <class What>
class CryptomattePlane {
  public:
    using Sum = WeightsById;
    static constexpr std::string_view name = What::name;
    static constexpr bool by_default = false;
    /// The maximum number of things stored per pixel, those with the greatest coverage; two per layer of four channels.
    static constexpr std::size_t ranks = 6;

    explicit CryptomattePlane(const SceneNames& scene_names)
        : names_(What::names(scene_names)), phases_(scene_names.phases.size()) {
        for (const std::string& n : names_) ids_.push_back(cryptomatte_id(n));
    }

    std::vector<std::string> channels() const {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < ranks / 2; ++i)
            for (const char* channel : {".R", ".G", ".B", ".A"})
                all.push_back(std::string(What::layer) + "0" + std::to_string(i) + channel);
        return all;
    }
    std::vector<std::pair<std::string, std::string>> attributes() const {
        return cryptomatte_attributes(std::string(What::layer), names_);
    }
    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        if (!sample.record || !sample.record->first) return;
        const std::optional<std::size_t> shown = What::shown(*sample.record->first, phases_);
        if (shown) sums[0].add(ids_[*shown], 1.0f, faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        auto entries = sums[0].entries();  // by increasing IDs, which breaks ties between equal weights
        std::ranges::stable_sort(entries, std::greater<>(), [](const auto& e) { return e.weight.value(); });
        for (std::size_t i = 0; i < std::min(entries.size(), ranks); ++i) {
            values[2 * i] = std::bit_cast<float>(entries[i].id);
            values[2 * i + 1] = static_cast<float>(entries[i].weight.value() / samples);
        }
    }

  private:
    std::vector<std::string> names_;
    std::vector<std::uint32_t> ids_;
    std::size_t phases_;
};

/// The phase entered; meshes have none.
struct MattePhase {
    static constexpr std::string_view name = "crypto_phase";
    static constexpr std::string_view layer = "CryptoPhase";
    static const std::vector<std::string>& names(const SceneNames& s) { return s.phases; }
    static std::optional<std::size_t> shown(const RecordedSurface& r, std::size_t) {
        return r.phase_to ? std::optional<std::size_t>(r.phase_to->index) : std::nullopt;
    }
};
/// Each object of phases, and each mesh.
struct MatteObject {
    static constexpr std::string_view name = "crypto_object";
    static constexpr std::string_view layer = "CryptoObject";
    static const std::vector<std::string>& names(const SceneNames& s) { return s.objects; }
    static std::optional<std::size_t> shown(const RecordedSurface& r, std::size_t) { return r.object; }
};
/// A material is named after the phase or mesh that has it. With several objects of phases, the manifest also contains
/// the names of all but the first of them, which no surface shows.
struct MatteMaterial {
    static constexpr std::string_view name = "crypto_material";
    static constexpr std::string_view layer = "CryptoMaterial";
    static std::vector<std::string> names(const SceneNames& s) {
        std::vector<std::string> all = s.phases;
        if (!s.objects.empty()) all.insert(all.end(), s.objects.begin() + 1, s.objects.end());
        return all;
    }
    static std::optional<std::size_t> shown(const RecordedSurface& r, std::size_t phases) {
        return r.phase_to ? r.phase_to->index : phases + r.object - 1;
    }
};

using CryptoPhasePlane = CryptomattePlane<MattePhase>;
using CryptoObjectPlane = CryptomattePlane<MatteObject>;
using CryptoMaterialPlane = CryptomattePlane<MatteMaterial>;

}  // namespace phasetree::tracer
