// The kinds of cameras in scene files: one list, which drives the reader, the reference and the schema. made() converts
// what the scene file says into the camera's parameters.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.hpp"
#include "film/pixel_filter.hpp"
#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree::tracer {

std::vector<std::string_view> names_of_filters();
/// The filter with one of these names.
PixelFilter filter_of_name(std::string_view name);

/// Parameters of every camera, in addition to those of its kind.
struct CameraInFile {
    float turn_degrees = 0;
    std::string filter_name = "blackman_harris";
};

/// Visits what all kinds have: the camera's position, and the film's filter.
template <class P, class V>
void view_parameters(V&& v) {
    v(&P::position, Parameter{"position", "m", "Where it is.", coordinate});
    v(&P::look_at, Parameter{"look_at", "m", "A point in the middle of the image.", coordinate});
    v(&P::up, Parameter{"up", "", "A direction that is up in the image; +y, or +x, if it looks along that.",
                        limits::any, true});
    v(&P::turn_degrees,
      Parameter{
          "turn", "degrees",
          "Angle by which the camera goes around the axis up through look_at, to its own right at first. With keys "
          "that is a turntable.",
          limits::any, true});
    v(&P::filter_name,
      ChoiceParameter{{"filter", "", "How samples are spread about the middle of a pixel.", limits::any, true},
                      names_of_filters});
}

/// Visits what cameras with a lens have: field of view, aperture and focus.
template <class P, class V>
void lens_parameters(V&& v) {
    v(&P::vertical_fov_degrees, Parameter{"fov", "degrees", "Angle between the upper and the lower edge of the image.",
                                          Limits{.low = 0, .high = 180, .low_open = true, .high_open = true}, true});
    v(&P::lens_radius, Parameter{"lens_radius", "m", "Radius of the lens; what is out of focus blurs by it.",
                                 Limits{.low = 0, .high = farthest}, true});
    v(&P::blades,
      Parameter{"blades", "",
                "Corners of the lens's opening, 3 or more, as an iris of this many blades makes them; 0 is a "
                "disk.",
                Limits{.low = 0, .high = Aperture::most_blades}, true});
    v(&P::rotation_degrees,
      Parameter{"blade_rotation", "degrees", "Angle by which the opening is turned; at 0 a corner is at the right.",
                limits::any, true});
    v(&P::focus_distance,
      Parameter{"focus_distance", "m", "Distance of the plane of focus; without it, the plane is at look_at.",
                limits::positive, true});
    v(&P::focus_at,
      Parameter{"focus_at", "m", "Instead of the distance: a point of the plane of focus.", coordinate, true});
}

struct ThinLensKind : ThinLensParameters, CameraInFile {
    static constexpr KindInfo info{
        "thin_lens", "A lens with a plane of focus; a pinhole, if its radius is 0. The kind need not be named."};

    std::optional<glm::vec3> focus_at{};
    template <class V>
    static void parameters(V&& v) {
        using P = ThinLensKind;
        view_parameters<P>(v);
        lens_parameters<P>(v);
    }
    /// Throws ParameterError.
    ThinLensParameters made() const;
};

struct TiltShiftKind : TiltShiftParameters, CameraInFile {
    static constexpr KindInfo info{
        "tilt_shift", "A lens that shifts, so that verticals stay parallel, and whose plane of focus tilts."};

    std::optional<glm::vec3> focus_at{};
    template <class V>
    static void parameters(V&& v) {
        using P = TiltShiftKind;
        view_parameters<P>(v);
        lens_parameters<P>(v);
        v(&P::shift, Parameter{"shift", "",
                               "By which what is shown lies farther to the right and farther up, in heights of the "
                               "image: with [0, 0.5] its lower edge is where its middle was.",
                               Limits{.low = -100, .high = 100}, true});
        v(&P::tilt, Parameter{"tilt", "degrees",
                              "By which the plane of focus leans away at its top, and turns away at its right.",
                              Limits{.low = -90, .high = 90, .low_open = true, .high_open = true}, true});
    }
    /// Throws ParameterError.
    TiltShiftParameters made() const;
};

struct PanoramaKind : PanoramaParameters, CameraInFile {
    static constexpr KindInfo info{"panorama",
                                   "All directions, on an image that should be twice as wide as high (equirectangular, "
                                   "lat-long)."};

    template <class V>
    static void parameters(V&& v) {
        view_parameters<PanoramaKind>(v);
    }
    PanoramaParameters made() const { return *this; }
};

struct DomeKind : DomeParameters, CameraInFile {
    static constexpr KindInfo info{
        "dome",
        "A fisheye for domes: the angle from the middle grows evenly outwards, and the widest "
        "circle of the image has the field of view."};

    template <class V>
    static void parameters(V&& v) {
        using P = DomeKind;
        view_parameters<P>(v);
        v(&P::fov_degrees, Parameter{"fov", "degrees", "Angle across the circle.",
                                     Limits{.low = 0, .high = 360, .low_open = true}, true});
    }
    DomeParameters made() const { return *this; }
};

struct OrthographicKind : OrthographicParameters, CameraInFile {
    static constexpr KindInfo info{"orthographic",
                                   "All rays are parallel, so that lengths across them are the same at any distance."};
    /// The widest picture has an aspect ratio of 32,768, and rays start no farther away than `farthest`.
    static constexpr float highest = 1e10f;

    template <class V>
    static void parameters(V&& v) {
        using P = OrthographicKind;
        view_parameters<P>(v);
        v(&P::height, Parameter{"height", "m", "What the height of the whole image shows.",
                                Limits{.low = 0, .high = highest, .low_open = true}});
    }
    OrthographicParameters made() const { return *this; }
};

using CameraKinds = TypeList<ThinLensKind, OrthographicKind, TiltShiftKind, PanoramaKind, DomeKind>;

}  // namespace phasetree::tracer
