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
    v(&P::position, Parameter{"position", "m", "Position of the camera.", coordinate});
    v(&P::look_at, Parameter{"look_at", "m", "Point at the centre of the image.", coordinate});
    v(&P::up, Parameter{"up", "",
                        "Direction that points up in the image. If the camera looks along it, +y is used instead, or "
                        "+x if it looks along +y.",
                        limits::any, true});
    v(&P::turn_degrees, Parameter{"turn", "degrees",
                                  "Rotates the camera's position about the axis through `look_at` in the direction "
                                  "`up`; positive angles move the camera to its right. Animate it for a turntable.",
                                  limits::any, true});
    v(&P::filter_name,
      ChoiceParameter{{"filter", "", "Distribution of samples around the centre of a pixel.", limits::any, true},
                      names_of_filters});
}

/// Visits what cameras with a lens have: field of view, aperture and focus.
template <class P, class V>
void lens_parameters(V&& v) {
    v(&P::vertical_fov_degrees, Parameter{"fov", "degrees", "Vertical field of view.",
                                          Limits{.low = 0, .high = 180, .low_open = true, .high_open = true}, true});
    v(&P::lens_radius, Parameter{"lens_radius", "m", "Radius of the lens, which blurs objects that are out of focus.",
                                 Limits{.low = 0, .high = farthest}, true});
    v(&P::blades,
      Parameter{"blades", "",
                "Number of aperture blades, and of corners of the aperture: 3 or more; 0 for a circular aperture.",
                Limits{.low = 0, .high = Aperture::most_blades}, true});
    v(&P::rotation_degrees, Parameter{"blade_rotation", "degrees",
                                      "Rotation of the aperture; at 0 a corner points right.", limits::any, true});
    v(&P::focus_distance,
      Parameter{"focus_distance", "m", "Distance of the plane of focus; by default that of look_at.", limits::positive,
                true});
    v(&P::focus_at,
      Parameter{"focus_at", "m", "Instead of the distance: a point on the plane of focus.", coordinate, true});
}

struct ThinLensKind : ThinLensParameters, CameraInFile {
    static constexpr KindInfo info{"thin_lens",
                                   "A thin lens with a plane of focus, or a pinhole if its radius is 0. This is the "
                                   "default kind, whose name may be omitted."};

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
        "tilt_shift",
        "A lens that can be shifted, so that verticals stay parallel, and whose plane of focus can be tilted."};

    std::optional<glm::vec3> focus_at{};
    template <class V>
    static void parameters(V&& v) {
        using P = TiltShiftKind;
        view_parameters<P>(v);
        lens_parameters<P>(v);
        v(&P::shift, Parameter{"shift", "",
                               "Shift of the view to the right and up, in heights of the image: with [0, 0.5] the "
                               "lower edge is where the centre was.",
                               Limits{.low = -100, .high = 100}, true});
        v(&P::tilt,
          Parameter{
              "tilt", "degrees",
              "Tilt of the plane of focus: the angles by which its top and its right side turn away from the camera.",
              Limits{.low = -90, .high = 90, .low_open = true, .high_open = true}, true});
    }
    /// Throws ParameterError.
    TiltShiftParameters made() const;
};

struct PanoramaKind : PanoramaParameters, CameraInFile {
    static constexpr KindInfo info{
        "panorama",
        "A panorama of all directions in latitude-longitude format. The image should be twice as wide as high."};

    template <class V>
    static void parameters(V&& v) {
        view_parameters<PanoramaKind>(v);
    }
    PanoramaParameters made() const { return *this; }
};

struct DomeKind : DomeParameters, CameraInFile {
    static constexpr KindInfo info{"dome",
                                   "An equidistant fisheye for domes: the angle from the centre is proportional to the "
                                   "radius, and the largest circle in the image has the field of view."};

    template <class V>
    static void parameters(V&& v) {
        using P = DomeKind;
        view_parameters<P>(v);
        v(&P::fov_degrees, Parameter{"fov", "degrees", "Angle across the whole circle.",
                                     Limits{.low = 0, .high = 360, .low_open = true}, true});
    }
    DomeParameters made() const { return *this; }
};

struct OrthographicKind : OrthographicParameters, CameraInFile {
    static constexpr KindInfo info{
        "orthographic",
        "An orthographic camera: all rays are parallel, so objects have the same size at any distance."};
    /// The maximum height. In the widest picture, which is 32,768 times as wide as high, rays then still start within
    /// `farthest`, the limit of coordinates.
    static constexpr float highest = 1e10f;

    template <class V>
    static void parameters(V&& v) {
        using P = OrthographicKind;
        view_parameters<P>(v);
        v(&P::height,
          Parameter{"height", "m", "Height of the visible area.", Limits{.low = 0, .high = highest, .low_open = true}});
    }
    OrthographicParameters made() const { return *this; }
};

using CameraKinds = TypeList<ThinLensKind, OrthographicKind, TiltShiftKind, PanoramaKind, DomeKind>;

}  // namespace phasetree::tracer
