// Texture images that are kept while a scene is read again and again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "image/texture_image.hpp"

namespace phasetree::tracer {

/// Keeps images as long as a scene uses them and their files, or their bytes, stay the same. Not thread-safe.
class KeptImages {
  public:
    using Load = std::function<std::shared_ptr<const TextureImage>()>;

    /// While it exists, images that this thread loads are kept.
    class Use {
      public:
        explicit Use(KeptImages& images);
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        ~Use();

      private:
        KeptImages* before_;
    };

    /// Those that this thread uses, or null.
    static KeptImages* of_thread();

    /// The image of a file: a kept one, or the one that `load` returns.
    std::shared_ptr<const TextureImage> get(const std::filesystem::path& file, ImageMeaning meaning, const Load& load);
    /// Likewise for an image that is embedded in another file.
    std::shared_ptr<const TextureImage> get_embedded(const std::string& bytes, ImageMeaning meaning, const Load& load);

  private:
    struct State {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;

        bool operator==(const State&) const = default;
    };
    struct Kept {
        State state;
        std::weak_ptr<const TextureImage> image;
    };

    void forget_unused();
    static State state_of(const std::filesystem::path& file);
    std::shared_ptr<const TextureImage> get(const std::pair<std::string, ImageMeaning>& key, const State& state,
                                            const Load& load);

    std::map<std::pair<std::string, ImageMeaning>, Kept> images_;  // by file or bytes
};

}  // namespace phasetree::tracer
