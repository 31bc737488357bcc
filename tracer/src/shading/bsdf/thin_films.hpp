// A cache of thin films and their tables, shared by equal surfaces.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "shading/bsdf/film_of_surface.hpp"
#include "shading/thin_film.hpp"

namespace phasetree::tracer {

/// Films depend only on their layers and thicknesses, so the cache may be kept from one scene to the next. Not
/// thread-safe.
class ThinFilms {
  public:
    std::shared_ptr<const ThinFilm> film(const ThinFilm::Layers& layers, const ValueRange& thickness) {
        const Key key{layers, thickness};
        const auto found = std::ranges::find(made_, key, &std::pair<Key, std::shared_ptr<const ThinFilm>>::first);
        if (found != made_.end()) return found->second;
        auto film = std::make_shared<const ThinFilm>(layers, thickness.least, thickness.greatest);
        made_.emplace_back(key, film);
        return film;
    }
    /// Discards films that are no longer in use elsewhere.
    void forget_unused() {
        std::erase_if(made_, [](const auto& one) { return one.second.use_count() == 1; });
    }

  private:
    struct Key {
        ThinFilm::Layers layers;
        ValueRange thickness;
        bool operator==(const Key&) const = default;
    };
    std::vector<std::pair<Key, std::shared_ptr<const ThinFilm>>> made_;
};

}  // namespace phasetree::tracer
