// What a picture looks like on a display: exposure, then OpenColorIO's transform of a display and a view.
//
// $OCIO names the configuration; unset or empty, the built-in one (tracer/color/phasetree.ocio) is used. Its views, all
// for an sRGB display:
//   Photographic   ACES 1.0 SDR after an exposure that puts 18 % grey where the sRGB curve puts it (code 118). The
//                  default: highlights in glass roll off softly instead of clipping, and mid-tones are not darkened.
//   ACES 1.0 SDR   the ACES output transform as it is (18 % grey is code 91)
//   Standard       the sRGB curve alone; what exceeds 1 clips
//   Raw            the linear values themselves
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace phasetree::tracer {

class DisplayTransform {
  public:
    /// Without a display or view the configuration's default is meant. Throws DisplayError where $OCIO cannot be read,
    /// or a name is unknown; the message lists the known ones.
    explicit DisplayTransform(std::optional<std::string> display = std::nullopt,
                              std::optional<std::string> view = std::nullopt, float exposure_ev = 0.0f);

    /// Turns linear Rec.709 into display values, in place; [0, 1] is what the display can show. Pixels that are not
    /// finite become black. Each pixel is treated by itself; any number of threads may call this at once.
    void apply(std::span<glm::vec3> pixels) const;

    const std::string& display() const { return display_; }
    const std::string& view() const { return view_; }
    float exposure_ev() const { return exposure_ev_; }

    /// Whether the display's values are sRGB ones, so that a file may be tagged so.
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
