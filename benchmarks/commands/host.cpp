// The costs of a host of the C99 interface besides tracing: decoding hits, cells from a file, points.
//
// Uses the C99 interface, as other renderers do. Compares decoding a hit with tracing the ray that found it, reading a
// geometry's cells from a file with building them, and points all at once with one at a time.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <random>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "phasetree/phasetree_embree.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "rays/camera_rays.hpp"
#include "trace/many.hpp"

namespace phasetree::bench {

namespace {

// A scene of a host, which contains a single tree.
class Host {
  public:
    explicit Host(const std::string& scene)
        : device_(rtcNewDevice("threads=1")),
          tree(embree::Tree::from_file(std::string(PHASETREE_SCENES) + "/" + scene + ".json")),
          geometry(device_, tree),
          scene_(rtcNewScene(device_)) {
        rtcCommitGeometry(geometry.embree());
        rtcAttachGeometry(scene_, geometry.embree());
        rtcCommitScene(scene_);
    }
    ~Host() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    RTCDevice device() const { return device_; }
    RTCRayHit intersect(const Ray& ray) const {
        RTCRayHit hit = rayhit_of(ray);
        embree::Context context;
        embree::initialise(context);
        embree::intersect(scene_, context, hit);
        return hit;
    }

  private:
    RTCDevice device_;

  public:
    embree::Tree tree;
    embree::Geometry geometry;

  private:
    RTCScene scene_;
};

// Times tracing the rays that hit, and decoding their hits.
Turns decoding(const Host& host, const Rays& camera, const Settings& settings) {
    Rays hitting;
    std::vector<RTCRayHit> hits;
    for (const Ray& ray : camera) {
        const RTCRayHit hit = host.intersect(ray);
        if (!embree::is_hit(hit)) continue;
        hitting.push_back(ray);
        hits.push_back(hit);
    }
    const auto trace = [&] {
        Checksum sum;
        for (const Ray& ray : hitting) {
            ++sum.rays;
            sum.distance += static_cast<double>(host.intersect(ray).ray.tfar);
        }
        return sum;
    };
    const auto decode = [&] {
        Checksum sum;
        for (const RTCRayHit& hit : hits) {
            ++sum.rays;
            sum.distance += static_cast<double>(host.geometry.decode(hit).tFrom);
        }
        return sum;
    };
    return in_turn({{"ray", trace}, {"decode", decode}}, settings.timing_of_one_thread());
}

Turns reading(const Host& host, const std::string& file, const Settings& settings) {
    host.geometry.write_cells(file);
    const auto cells_of = [](const embree::Geometry& geometry) { return Checksum{geometry.statistics().cells, 0, 0}; };
    Timing timing = settings.timing_of_one_thread();
    timing.least_seconds = 0;
    if (settings.quick) timing.rounds = 1;
    return in_turn({{"build", [&] { return cells_of(embree::Geometry(host.device(), host.tree)); }},
                    {"read", [&] { return cells_of(embree::Geometry::from_cells(host.device(), host.tree, file)); }}},
                   timing);
}

Turns asking(const Host& host, const Settings& settings) {
    const RTCBounds box = host.tree.bounds();
    std::mt19937 random(settings.seed);
    std::uniform_real_distribution<float> unit;
    std::vector<std::array<float, 3>> points(settings.quick ? 256 : 4096);
    const auto between = [&](float low, float high) { return low + (high - low) * unit(random); };
    for (auto& p : points)
        p = {between(box.lower_x, box.upper_x), between(box.lower_y, box.upper_y), between(box.lower_z, box.upper_z)};
    const auto each = [&] {
        Checksum sum;
        for (const auto& p : points) {
            ++sum.rays;
            sum.hits += host.geometry.phase(p);
        }
        return sum;
    };
    const auto all = [&] {
        Checksum sum;
        for (const unsigned phase : host.geometry.phases(points)) {
            ++sum.rays;
            sum.hits += phase;
        }
        return sum;
    };
    return in_turn({{"one at a time", each}, {"at once", all}}, settings.timing_of_one_thread());
}

}  // namespace

Report host(const Settings& settings) {
    Report report("host", "costs of a host of the C99 interface besides tracing");
    report.say(fmt::format("{}×{} camera rays with an ordinary context, only those that hit; each hit is decoded",
                           settings.width, settings.height));
    report.say("a geometry with cells from a file compared with one that is built, including Embree's BVH; one thread");
    report.say("the phase at random points of the bounds, one point per call compared with all points in one call");
    Table table({{"scene", "scene", ""},
                 {"ray_seconds", "ray ns", "{:.0f}", 1e9},
                 {"decode_seconds", "decode ns", "{:.0f}", 1e9},
                 {"decode_ratio", "decode/ray", "{:.2f}"},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"read_seconds", "read s", "{:.3f}"},
                 {"read_ratio", "read/build", "{:.3f}"},
                 {"point_seconds", "point ns", "{:.0f}", 1e9},
                 {"points_ratio", "at once/one", "{:.2f}"}});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const support::TemporaryDirectory folder;  // removed at the end of the benchmark
    double decode = 0, read = 0;
    std::vector<std::string> names{"hourglass", "cable"};
    if (!settings.quick) names.insert(names.end(), {"drinks", "tentacle"});
    for (const std::string& name : names) {
        const Host host(name);
        const Rays camera = camera_rays(scene_file(name).camera, settings.width, settings.height);
        const Turns hits = decoding(host, camera, settings), cells = reading(host, folder / "cells", settings),
                    points = asking(host, settings);
        const auto each = [](const Turns& turns, std::size_t i) {
            return turns.seconds(i).median / static_cast<double>(turns.checksum(i).rays);
        };
        table.row({name, each(hits, 0), each(hits, 1), hits.ratio(1, 0), cells.seconds(0), cells.seconds(1),
                   cells.ratio(1, 0), each(points, 0), points.ratio(1, 0)});
        decode = std::max(decode, hits.ratio(1, 0).median);
        read = std::max(read, cells.ratio(1, 0).median);
    }
    report.table("scenes", table);
    report.at_most("time to decode a hit, relative to tracing the ray, worst of four scenes", decode, 1);
    report.at_most("time to read cells, relative to building them, worst of four scenes", read, 0.25);
    return report;
}

}  // namespace phasetree::bench
