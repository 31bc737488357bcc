// What the camera sees: the first surface, and the first that is not perfectly smooth, "behind" glass or in a mirror
// (path_record.hpp).
#pragma once

#include <algorithm>
#include <array>

#include "film/recorded_plane.hpp"

namespace phasetree::tracer {

/// The depth of samples that meet nothing, as written by Blender.
inline constexpr float no_depth = 1e10f;

/// A property of the first surface.
template <class What>
struct OfFirst : What {
    static auto of(const FilmSample& s) -> decltype(std::optional(What::of_surface(s, *s.record->first))) {
        if (!s.record || !s.record->first) return std::nullopt;
        return What::of_surface(s, *s.record->first);
    }
};

/// A property of the first surface that is not perfectly smooth.
template <class What>
struct OfBehind : What {
    /// Divided by the limit because sums of weights accept numbers from 0 to 1.
    static float weight(const FilmSample& s) { return std::min(s.record->weight / PathRecord::weight_limit, 1.0f); }
    static auto of(const FilmSample& s) -> decltype(std::optional(What::of_surface(s, *s.record->behind))) {
        if (!s.record || !s.record->behind) return std::nullopt;
        return What::of_surface(s, *s.record->behind);
    }
};

struct Depth {
    static constexpr std::string_view name = "depth";
    static constexpr std::array<std::string_view, 1> channels{"depth.Z"};
    static constexpr float otherwise = no_depth;
    static std::array<float, 1> of_surface(const FilmSample& s, const RecordedSurface&) { return {s.depth}; }
};
struct Position {
    static constexpr std::string_view name = "position";
    static constexpr std::array<std::string_view, 3> channels{"position.X", "position.Y", "position.Z"};
    static constexpr float otherwise = 0;
    static auto of_surface(const FilmSample&, const RecordedSurface& r) { return components(r.position); }
};
struct Normal {
    static constexpr std::string_view name = "normal";
    static constexpr std::array<std::string_view, 3> channels{"normal.X", "normal.Y", "normal.Z"};
    static auto of_surface(const FilmSample&, const RecordedSurface& r) { return components(r.normal); }
};
struct Albedo {
    static constexpr std::string_view name = "albedo";
    static constexpr std::array<std::string_view, 3> channels{"albedo.R", "albedo.G", "albedo.B"};
    static auto of_surface(const FilmSample&, const RecordedSurface& r) { return components(r.albedo); }
};

struct DepthBehind {
    static constexpr std::string_view name = "depth_behind";
    static constexpr std::array<std::string_view, 1> channels{"depth_behind.Z"};
    static constexpr float otherwise = no_depth;
    static std::array<float, 1> of_surface(const FilmSample&, const RecordedSurface& r) { return {r.distance}; }
};
struct PositionBehind : Position {
    static constexpr std::string_view name = "position_behind";
    static constexpr std::array<std::string_view, 3> channels{"position_behind.X", "position_behind.Y",
                                                              "position_behind.Z"};
};
struct NormalBehind : Normal {
    static constexpr std::string_view name = "normal_behind";
    static constexpr std::array<std::string_view, 3> channels{"normal_behind.X", "normal_behind.Y", "normal_behind.Z"};
    static auto of_surface(const FilmSample& s, const RecordedSurface& r) {
        return components(s.record->weight * r.normal);
    }
};
struct AlbedoBehind : Albedo {  // the throughput includes the weight
    static constexpr std::string_view name = "albedo_behind";
    static constexpr std::array<std::string_view, 3> channels{"albedo_behind.R", "albedo_behind.G", "albedo_behind.B"};
};

/// IDs, or −1 if there is none.
struct PhaseLeft {
    static constexpr std::string_view name = "phase_from";
    static constexpr std::array<std::string_view, 1> channels{"phase_from.X"};
    static constexpr float otherwise = -1;
    static std::array<float, 1> of_surface(const FilmSample&, const RecordedSurface& r) {
        return {static_cast<float>(r.phase_from.index)};
    }
};
struct PhaseEntered {
    static constexpr std::string_view name = "phase_to";
    static constexpr std::array<std::string_view, 1> channels{"phase_to.X"};
    static constexpr float otherwise = -1;
    static std::array<float, 1> of_surface(const FilmSample&, const RecordedSurface& r) {
        return {r.phase_to ? static_cast<float>(r.phase_to->index) : -1.0f};
    }
};
struct ObjectNumber {
    static constexpr std::string_view name = "object";
    static constexpr std::array<std::string_view, 1> channels{"object.X"};
    static constexpr float otherwise = -1;
    static std::array<float, 1> of_surface(const FilmSample&, const RecordedSurface& r) {
        return {static_cast<float>(r.object)};
    }
};
struct InstanceNumber {
    static constexpr std::string_view name = "instance";
    static constexpr std::array<std::string_view, 1> channels{"instance.X"};
    static constexpr float otherwise = -1;
    static std::array<float, 1> of_surface(const FilmSample&, const RecordedSurface& r) {
        return {static_cast<float>(r.instance)};
    }
};

/// Depth along the camera's axis, of the first sample that meets a surface.
using DepthPlane = FirstSamplePlane<OfFirst<Depth>>;
using PositionPlane = FirstSamplePlane<OfFirst<Position>>;
using NormalPlane = MeanPlane<OfFirst<Normal>>;
using AlbedoPlane = MeanPlane<OfFirst<Albedo>>;
/// The mean length of the paths to what is seen behind glass.
using DepthBehindPlane = MeanOfHitsPlane<OfBehind<DepthBehind>>;
using PositionBehindPlane = MeanOfHitsPlane<OfBehind<PositionBehind>>;
using NormalBehindPlane = MeanPlane<OfBehind<NormalBehind>>;
using AlbedoBehindPlane = MeanPlane<OfBehind<AlbedoBehind>>;
using PhaseLeftPlane = FirstSamplePlane<OfFirst<PhaseLeft>>;
using PhaseEnteredPlane = FirstSamplePlane<OfFirst<PhaseEntered>>;
using ObjectPlane = FirstSamplePlane<OfFirst<ObjectNumber>>;
using InstancePlane = FirstSamplePlane<OfFirst<InstanceNumber>>;

}  // namespace phasetree::tracer
