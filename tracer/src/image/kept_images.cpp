#include "image/kept_images.hpp"

#include <system_error>

namespace phasetree::tracer {

namespace {

thread_local KeptImages* images_of_thread = nullptr;

}  // namespace

KeptImages::Use::Use(KeptImages& images) : before_(std::exchange(images_of_thread, &images)) {
    images.forget_unused();
}

KeptImages::Use::~Use() {
    images_of_thread = before_;
}

KeptImages* KeptImages::of_thread() {
    return images_of_thread;
}

// If the file cannot be read, its state is arbitrary, because loading it throws.
KeptImages::State KeptImages::state_of(const std::filesystem::path& file) {
    std::error_code error;
    return {std::filesystem::last_write_time(file, error), std::filesystem::file_size(file, error)};
}

std::shared_ptr<const TextureImage> KeptImages::get(const std::filesystem::path& file, ImageMeaning meaning,
                                                    const Load& load) {
    return get(std::pair(file.string(), meaning), state_of(file), load);
}

std::shared_ptr<const TextureImage> KeptImages::get_embedded(const std::string& bytes, ImageMeaning meaning,
                                                             const Load& load) {
    return get(std::pair(bytes, meaning), State{}, load);
}

std::shared_ptr<const TextureImage> KeptImages::get(const std::pair<std::string, ImageMeaning>& key, const State& state,
                                                    const Load& load) {
    if (const auto known = images_.find(key); known != images_.end() && known->second.state == state)
        if (std::shared_ptr<const TextureImage> image = known->second.image.lock()) return image;
    std::shared_ptr<const TextureImage> image = load();
    forget_unused();
    images_[key] = {state, image};
    return image;
}

void KeptImages::forget_unused() {
    std::erase_if(images_, [](const auto& kept) { return kept.second.image.expired(); });
}

}  // namespace phasetree::tracer
