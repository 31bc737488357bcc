// Points of surfaces that pages have grabbed in the picture, and where they are dragged to.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "studio/edited_document.hpp"
#include "view/drag.hpp"
#include "view/shown.hpp"

namespace phasetree::tracer::view {

/// A grabbed point, and the numbers that move it.
struct Grabbed {
    std::uint64_t number = 0;
    std::shared_ptr<const VariedObject> object;
    AnyCameraParameters camera;
    glm::ivec2 resolution{0};
    InterfacePoint point;
    glm::dvec3 facing{0};
    double pixel = 0;  ///< the width of a pixel at the point, in the scene's unit
    std::vector<Influence> influences;
};

/// Throws ModelError, with a message for people, if there is no surface of the object, or no number moves it.
/// `place` is in pixels of the whole picture.
Grabbed grab(const Picture& picture, const glm::vec2& place, const Document& document, const VariedObject::Parse& parse,
             const studio::Vocabulary& vocabulary);

/// Only the numbers in `chosen` change; the answer has the others, too. Not thread-safe.
Dragged drag(const Grabbed& grabbed, const glm::vec2& place, const std::set<std::string>& chosen);

/// The points that were grabbed last, for any number of pages. Thread-safe.
class Grabs {
  public:
    static constexpr std::size_t most = 4, most_influences = 24;
    /// The object is read many times, so a request for one that is expensive to read is given up after this time.
    static constexpr std::chrono::milliseconds longest{10000};

    explicit Grabs(studio::EditedDocument& document, std::chrono::milliseconds longest_request = longest)
        : document_(document), longest_(longest_request) {}

    /// The answers to requests, as lines of JSON: {"x": 12.5, "y": 7} in pixels of the picture, and {"grab": 3, "x":
    /// 14, "y": 7, "chosen": ["/tree/…"]}. Throw SceneError, and ModelError with a reason for people.
    std::string grab(const std::string& request, const Shown& shown);
    std::string drag(const std::string& request, const Shown& shown);

  private:
    template <class Work>
    auto in_time(Work&& work) const;

    studio::EditedDocument& document_;
    const std::chrono::milliseconds longest_;
    std::mutex mutex_;
    std::deque<Grabbed> grabs_;
    std::uint64_t last_ = 0;
};

}  // namespace phasetree::tracer::view
