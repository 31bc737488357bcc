#include "output/default_config.hpp"

namespace phasetree::tracer {

namespace {

// The text of tracer/color/phasetree.ocio; a test checks that both are identical.
constexpr std::string_view text = R"ocio(ocio_profile_version: 2

# The colours of phasetree, for OpenColorIO 2.1 and later. The path tracer has the same text built in; install this
# file for the other tools in a pipeline (export OCIO=/path/to/phasetree.ocio) and they show its images alike.
#
# Working space: linear Rec.709 / sRGB primaries, D65 white. Every transform is one of OpenColorIO's own; the one
# number here is the exposure of the photographic look.

name: phasetree
description: Linear Rec.709 scenes on an sRGB display, with ACES 1.0 SDR rendering.
environment: {}
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  color_picking: sRGB Texture
  color_timing: Linear Rec.709
  compositing_linear: Linear Rec.709
  compositing_log: Linear Rec.709
  data: Raw
  default: Linear Rec.709
  matte_paint: sRGB Texture
  reference: ACES2065-1
  rendering: Linear Rec.709
  scene_linear: Linear Rec.709
  texture_paint: sRGB Texture

file_rules:
  - !<Rule> {name: Photographs, pattern: "*", extension: "[pP][nN][gG]", colorspace: sRGB Texture}
  - !<Rule> {name: Default, colorspace: default}

shared_views:
  - !<View> {name: Photographic, view_transform: ACES 1.0 SDR, display_colorspace: sRGB Display, looks: Photographic}
  - !<View> {name: ACES 1.0 SDR, view_transform: ACES 1.0 SDR, display_colorspace: sRGB Display}
  - !<View> {name: Standard, view_transform: Standard, display_colorspace: sRGB Display}

displays:
  sRGB:
    - !<Views> [Photographic, ACES 1.0 SDR, Standard]
    - !<View> {name: Raw, colorspace: Raw}

active_displays: [sRGB]
active_views: [Photographic, ACES 1.0 SDR, Standard, Raw]

looks:
  - !<Look>
    name: Photographic
    process_space: Linear Rec.709
    description: |
      ACES renders middle grey darker than the plain sRGB curve does. This exposure puts 18 % grey at the same code
      value in both, so that the choice of view changes contrast and highlights, not brightness.
    transform: !<ExposureContrastTransform> {style: linear, exposure: 0.556381, contrast: 1, gamma: 1, pivot: 0.18}

default_view_transform: Standard

view_transforms:
  - !<ViewTransform>
    name: ACES 1.0 SDR
    description: The ACES 1.0 output transform for SDR video, a filmic curve with a soft shoulder.
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

  - !<ViewTransform>
    name: Standard
    description: No tone mapping. 1 is white, what is brighter clips.
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}

display_colorspaces:
  - !<ColorSpace>
    name: CIE-XYZ-D65
    aliases: [cie_xyz_d65]
    family: Display
    description: CIE XYZ, white D65, the display reference.
    isdata: false

  - !<ColorSpace>
    name: sRGB Display
    aliases: [srgb_display]
    family: Display
    encoding: sdr-video
    description: IEC 61966-2-1 sRGB.
    isdata: false
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

colorspaces:
  - !<ColorSpace>
    name: ACES2065-1
    aliases: [aces2065_1, lin_ap0]
    family: Scene
    encoding: scene-linear
    description: ACES AP0, the scene reference.
    isdata: false

  - !<ColorSpace>
    name: Linear Rec.709
    aliases: [Linear, lin_rec709, lin_srgb, Linear Rec.709 (sRGB)]
    family: Scene
    encoding: scene-linear
    description: Linear light, Rec.709 primaries, white D65. What the path tracer computes and writes to EXR.
    isdata: false
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: ACEScg
    aliases: [lin_ap1]
    family: Scene
    encoding: scene-linear
    description: ACES AP1, linear.
    isdata: false
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}

  - !<ColorSpace>
    name: sRGB Texture
    aliases: [sRGB, srgb_tx, srgb_texture]
    family: Texture
    encoding: sdr-video
    description: Rec.709 primaries with the sRGB curve, as in PNG and JPEG textures.
    isdata: false
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: Raw
    aliases: [Non-Color]
    family: Data
    encoding: data
    description: Numbers that are no colours, such as depth and normals.
    isdata: true
)ocio";

}  // namespace

std::string_view default_color_config() {
    return text;
}

}  // namespace phasetree::tracer
