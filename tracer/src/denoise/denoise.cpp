#include "denoise/denoise.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "denoise/features.hpp"
#include "denoise/glints.hpp"
#include "denoise/open_image_denoise.hpp"
#include "denoise/regression.hpp"
#include "denoise/similarity.hpp"
#include "film/half_plane.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

namespace {

constexpr int window_radius = 5;
constexpr int window_side = 2 * window_radius + 1;
constexpr std::size_t window_size = window_side * window_side;
static_assert(window_radius + patch_radius <= grid_margin);
// The k of similarity.hpp. Of 0.25, 0.35, 0.5 and 1, it had the smallest error in a crop of scenes/hourglass.json.
constexpr float k = 0.35f;
// Smaller weights have no visible effect, but take time.
constexpr float least_weight = 1e-4f;

// Each pixel's model predicts the radiance of all pixels of its window. This is the weighted sum of the predictions for
// one pixel by the models around it, and the sum of their weights, which give their mean.
struct Prediction {
    std::array<float, 3> sum{};
    float weight = 0;
};

// The tiles of a picture, in four colours as on a map: two tiles of the same colour are so far apart that no pixel is
// in windows of both. So tiles of one colour are written concurrently without a race. The colours are processed one
// after the other, which makes each pixel's sum independent of the number of threads.
class Tiles {
  public:
    static constexpr int side = 32, colours = 4;
    static_assert(side >= 2 * window_radius);

    Tiles(int width, int height) {
        for (int y = 0; y < height; y += side)
            for (int x = 0; x < width; x += side)
                of_colour_[static_cast<std::size_t>(x / side % 2 + 2 * (y / side % 2))].push_back(
                    {x, y, std::min(x + side, width), std::min(y + side, height)});
    }
    const std::vector<PixelRange>& of_colour(int colour) const { return of_colour_[static_cast<std::size_t>(colour)]; }
    std::size_t count() const {
        std::size_t sum = 0;
        for (const auto& tiles : of_colour_) sum += tiles.size();
        return sum;
    }

  private:
    std::array<std::vector<PixelRange>, colours> of_colour_;
};

// Tracks progress and cancellation.
class Work {
  public:
    Work(const DenoiseJob& job, std::size_t total) : job_(job), total_(total) {}

    // Calls a function for each tile; tiles of one colour are processed concurrently.
    template <class F>
    void for_each(const Tiles& tiles, F&& f) {
        for (int colour = 0; colour < Tiles::colours; ++colour) {
            const std::vector<PixelRange>& same = tiles.of_colour(colour);
            tbb::parallel_for(std::size_t{0}, same.size(), [&](std::size_t i) {
                if (stopped_ || job_.cancelled()) {
                    stopped_ = true;
                    return;
                }
                const FlushSubnormals flush;
                f(same[i]);
                const std::lock_guard lock(telling_);
                job_.progress(static_cast<double>(++done_) / static_cast<double>(total_));
            });
        }
    }
    bool stopped() const { return stopped_; }

  private:
    const DenoiseJob& job_;
    std::size_t total_, done_ = 0;
    std::mutex telling_;
    std::atomic<bool> stopped_ = false;
};

// The weights of a tile's pixels over their windows: window_size weights per pixel.
std::vector<float> weights_of(const Grid<Estimate<3>>& guide, const PixelRange& tile) {
    std::vector<float> of_offset(tile.size()), all(tile.size() * window_size);
    std::size_t o = 0;
    for (int dy = -window_radius; dy <= window_radius; ++dy)
        for (int dx = -window_radius; dx <= window_radius; ++dx, ++o) {
            weigh<3>(guide, 0, tile, dx, dy, k, of_offset);
            for (std::size_t i = 0; i < tile.size(); ++i) all[i * window_size + o] = of_offset[i];
        }
    return all;
}

// Fits a model around each pixel of a tile, and adds its predictions for the pixels of its window. Glints are excluded.
void predict(const Grid<Estimate<3>>& radiance, const Grid<std::uint8_t>& glints, const Grid<Estimate<3>>& guide,
             const Grid<Features>& features, const PixelRange& tile, Grid<Prediction>& predictions) {
    const std::vector<float> weights = weights_of(guide, tile);
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const float* const of_window = weights.data() + tile.index(x, y) * window_size;
            const auto each_of_window = [&](auto&& f) {
                std::size_t o = 0;
                for (int dy = -window_radius; dy <= window_radius; ++dy)
                    for (int dx = -window_radius; dx <= window_radius; ++dx, ++o)
                        if (of_window[o] > least_weight && radiance.has(x + dx, y + dy) && !glints.at(x + dx, y + dy))
                            f(x + dx, y + dy, of_window[o]);
            };
            if (glints.at(x, y)) continue;
            LocalModel model(features.at(x, y));
            each_of_window([&](int qx, int qy, float weight) {
                model.add(weight, features.at(qx, qy), radiance.at(qx, qy).mean);
            });
            model.solve();
            each_of_window([&](int qx, int qy, float weight) {
                const std::array<float, 3> says = model.at(features.at(qx, qy));
                Prediction& prediction = predictions.at(qx, qy);
                for (std::size_t c = 0; c < 3; ++c) prediction.sum[c] += weight * says[c];
                prediction.weight += weight;
            });
        }
}

std::optional<std::vector<glm::vec3>> filtered(const Image& image, const DenoiseJob& job) {
    const Halves halves = halves_of(image);
    const Tiles tiles(image.width, image.height);
    Work work(job, 3 * tiles.count());
    Grid<Features> features(image.width, image.height);
    work.for_each(tiles, [&](const PixelRange& tile) {
        const std::vector<Features> clean = without_noise(halves.features, tile);
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) features.at(x, y) = clean[tile.index(x, y)];
    });
    std::vector<glm::vec3> pixels(image.pixels.size());
    for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
        const Grid<Estimate<3>>& radiance = halves.pictures[half];
        const Grid<std::uint8_t> glints = glints_of(radiance);
        Grid<Prediction> predictions(image.width, image.height);
        work.for_each(tiles, [&](const PixelRange& tile) {
            // The weights come from the other half, whose noise is independent of the filtered one.
            predict(radiance, glints, halves.pictures[1 - half], features, tile, predictions);
        });
        if (work.stopped()) return std::nullopt;
        std::size_t i = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x, ++i) {
                const Prediction& p = predictions.at(x, y);
                const float share = half == 0 ? halves.shares.at(x, y) : 1 - halves.shares.at(x, y);
                // A model's slope can lead to negative values, which radiance cannot have.
                for (std::size_t c = 0; c < 3; ++c)
                    pixels[i][static_cast<int>(c)] +=
                        share * (glints.at(x, y) ? radiance.at(x, y).mean[c] : std::max(p.sum[c] / p.weight, 0.0f));
            }
    }
    return pixels;
}

}  // namespace

Planes::Choice denoising_planes() {
    Planes::Choice choice = Planes::by_default();
    choice[Planes::index_of<AlbedoPlane>()] = true;
    choice[Planes::index_of<NormalPlane>()] = true;
    choice[Planes::index_of<AlbedoBehindPlane>()] = true;
    choice[Planes::index_of<NormalBehindPlane>()] = true;
    choice[Planes::index_of<HalfOfSamplesPlane>()] = true;
    choice[Planes::index_of<SamplesPlane>()] = true;
    return choice;
}

std::optional<std::vector<glm::vec3>> denoise(const Image& image, const DenoiseJob& job) {
    if (job.by == Denoiser::network || (job.by == Denoiser::best && has_open_image_denoise()))
        return denoise_by_network(image, job);
    const int threads = job.threads > 0 ? job.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return filtered(image, job); });
}

}  // namespace phasetree::tracer
