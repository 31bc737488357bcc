// A number that varies over a mesh by an image, such as a roughness map.
#pragma once

#include <algorithm>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "image/texture_image.hpp"
#include "phasetree/io/kind.hpp"
#include "shading/texture/image_coordinates.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct MeshImageNumber {
    static constexpr KindInfo info{"mesh_image",
                                   "A number from an image on a mesh, by the texture coordinates in the mesh file."};

    static std::vector<std::string_view> names_of_channels() { return {"red", "green", "blue", "alpha"}; }

    std::filesystem::path file{};
    std::string channel_name{"red"};
    glm::vec2 repeat{1.0f};
    glm::vec2 range{0.0f, 1.0f};
    std::shared_ptr<const TextureImage> image{};  // set once it is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = MeshImageNumber;
        v(&P::file,
          Parameter{"file", "", "Image, of which one channel is used as stored: integers are not decoded from sRGB."});
        v(&P::channel_name,
          ChoiceParameter{{"channel", "", "Channel to use; in grey images all three are the same.", limits::any, true},
                          names_of_channels});
        v(&P::repeat, repeat_parameter);
        v(&P::range, Parameter{"range", "", "Numbers for black and white.", limits::any, true});
    }
    void prepare() {
        const bool is_alpha = channel_name == "alpha";
        image = load_texture_image(file, is_alpha ? ImageMeaning::alpha : ImageMeaning::numbers);
        channel = channel_name == "green" ? 1 : channel_name == "blue" ? 2 : 0;
        of_image = image->range(channel);
    }

    // A mesh without coordinates is rejected where the scene is read.
    float at(const TexturePoint& p) const { return number_of(image->at(coordinates.at(p) * repeat)[channel]); }
    // An image that has not been read yet is assumed to have both black and white.
    float least() const { return std::min(number_of(of_image.x), number_of(of_image.y)); }
    float greatest() const { return std::max(number_of(of_image.x), number_of(of_image.y)); }

    glm::vec2 of_image{0.0f, 1.0f};  // the range of the image's values, set once it is prepared
    int channel = 0;                 // of the image, from its name
    bool is_squared = false;         // of glTF's roughness; scene files do not say it
    ImageCoordinates coordinates{};  // of glTF's images; scene files do not say them

  private:
    float number_of(float value) const {
        const float number = (1 - value) * range.x + value * range.y;
        return is_squared ? number * number : number;
    }
};

}  // namespace phasetree::tracer
