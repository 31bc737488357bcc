// Converts a picture for a display: exposure, then OpenColorIO's transform for a display and a view.
//
// $OCIO names the configuration. If it is unset or empty, the built-in one (tracer/color/phasetree.ocio) is used. Its
// views, all for an sRGB display, are:
//   Photographic   ACES 1.0 SDR after an exposure that puts 18 % grey where the sRGB curve puts it (code 118). The
//                  default: highlights in glass roll off softly instead of clipping, and mid-tones are not darkened.
//   ACES 1.0 SDR   the plain ACES output transform (18 % grey is code 91)
//   Standard       the sRGB curve alone; values above 1 clip
//   Raw            the linear values
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace phasetree::tracer {

class DisplayTransform {
  public:
    /// Without a display or view, uses the configuration's default. Throws DisplayError if $OCIO cannot be read or a
    /// name is unknown; the message lists the known ones.
    explicit DisplayTransform(std::optional<std::string> display = std::nullopt,
                              std::optional<std::string> view = std::nullopt, float exposure_ev = 0.0f);

    /// Converts linear Rec.709 to display values in place; the display can show [0, 1]. Non-finite pixels become black.
    /// Each pixel is independent, and any number of threads may call this at once.
    void apply(std::span<glm::vec3> pixels) const;

    const std::string& display() const { return display_; }
    const std::string& view() const { return view_; }
    float exposure_ev() const { return exposure_ev_; }

    /// Whether the display's values are sRGB, so that files can be tagged accordingly.
    bool is_srgb() const;

  private:
    struct Processor;  ///< keeps OpenColorIO out of this header
    std::shared_ptr<const Processor> processor_;
    std::string display_;
    std::string view_;
    float exposure_ev_;
};

/// OpenColorIO's version.
std::string opencolorio_version();

}  // namespace phasetree::tracer
