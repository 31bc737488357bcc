#include "gltf/draco.hpp"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr std::string_view invalid = "contains invalid Draco data; export the file again, or without Draco compression";

// The library allocates as much memory as the data declare, so the numbers of triangles, vertices and attributes are
// checked first. `Decoder` is one of the library's mesh decoders.
template <class Decoder>
class LimitedDecoder : public Decoder {
  public:
    LimitedDecoder(const DracoLimits& limits, std::size_t size) : limits_(limits), size_(size) {}

    bool is_beyond_limits() const { return is_beyond_limits_; }

  protected:
    bool DecodeConnectivity() override {
        constexpr std::uint16_t version_of_gltf = DRACO_BITSTREAM_VERSION(2, 2);
        if (this->bitstream_version() != version_of_gltf) return false;
        // Data of the Edgebreaker method begin with the number of vertices, sequential data with the number of faces.
        draco::DecoderBuffer ahead = *this->buffer();
        std::uint32_t first = 0, second = 0;
        if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
        constexpr bool has_faces_first = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;
        const std::size_t faces = has_faces_first ? first : second, vertices = has_faces_first ? second : first;
        // Real meshes take far more than a hundredth of a bit per triangle.
        constexpr std::size_t most_faces_per_byte = 1000;
        is_beyond_limits_ = faces > limits_.triangles || vertices > limits_.vertices;
        if (is_beyond_limits_ || std::max(faces, vertices / 3) > most_faces_per_byte * size_) return false;
        return Decoder::DecodeConnectivity();
    }
    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *this->point_cloud();
        const std::size_t points = cloud.num_points();
        std::size_t bytes_per_point = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *cloud.attribute(i);
            const auto bytes = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
            // In addition to each number, there may be an integer from which it is computed.
            bytes_per_point += static_cast<std::size_t>(attribute.num_components()) * (bytes + sizeof(std::int32_t));
        }
        is_beyond_limits_ = points > limits_.vertices || (points > 0 && bytes_per_point > limits_.bytes / points);
        return !is_beyond_limits_ && Decoder::DecodeAllAttributes();
    }

  private:
    DracoLimits limits_;
    std::size_t size_;
    bool is_beyond_limits_ = false;
};

template <class Decoder>
void decode(std::string_view compressed, const DracoLimits& limits, draco::Mesh& mesh) {
    draco::DecoderBuffer buffer;
    buffer.Init(compressed.data(), compressed.size());
    LimitedDecoder<Decoder> decoder(limits, compressed.size());
    const draco::DecoderOptions options;
    const bool is_good = decoder.Decode(options, &buffer, &mesh).ok();
    if (decoder.is_beyond_limits())
        throw GltfError("has more triangles, vertices or numbers in its Draco data than its accessors declare");
    if (!is_good) throw GltfError(std::string(invalid));
}

void decode_mesh(std::string_view compressed, const DracoLimits& limits, draco::Mesh& mesh) {
    draco::DecoderBuffer buffer;
    buffer.Init(compressed.data(), compressed.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_type != draco::TRIANGULAR_MESH)
        throw GltfError(std::string(invalid));
    if ((header.flags & METADATA_FLAG_MASK) != 0)
        throw GltfError(
            "has metadata in its Draco data, which phasetree cannot read; export the file again without them");
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        decode<draco::MeshEdgebreakerDecoder>(compressed, limits, mesh);
    else
        decode<draco::MeshSequentialDecoder>(compressed, limits, mesh);
}

template <class Number>
std::string rows_of(const draco::PointAttribute& attribute, std::size_t points, std::size_t columns) {
    std::string rows(points * columns * sizeof(Number), '\0');
    auto* out = reinterpret_cast<Number*>(rows.data());
    for (std::uint32_t i = 0; i < points; ++i, out += columns) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size() || !attribute.ConvertValue(value, static_cast<std::int8_t>(columns), out))
            throw GltfError(std::string(invalid));
    }
    return rows;
}

std::string rows_of(const draco::Mesh& mesh, const DracoAttribute& wanted) {
    const draco::PointAttribute* const found = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(wanted.id));
    if (!found) throw GltfError(fmt::format("has no attribute {} in its Draco data", wanted.id));
    if (static_cast<std::size_t>(found->num_components()) != wanted.columns)
        throw GltfError(
            fmt::format("has rows of {} numbers in attribute {} of its Draco data, but its accessor declares {}",
                        found->num_components(), wanted.id, wanted.columns));
    switch (wanted.component_type) {
        case 5120:
            return rows_of<std::int8_t>(*found, mesh.num_points(), wanted.columns);
        case 5121:
            return rows_of<std::uint8_t>(*found, mesh.num_points(), wanted.columns);
        case 5122:
            return rows_of<std::int16_t>(*found, mesh.num_points(), wanted.columns);
        case 5123:
            return rows_of<std::uint16_t>(*found, mesh.num_points(), wanted.columns);
        case 5125:
            return rows_of<std::uint32_t>(*found, mesh.num_points(), wanted.columns);
        default:
            return rows_of<float>(*found, mesh.num_points(), wanted.columns);
    }
}

}  // namespace

bool has_draco() {
    return true;
}

DracoMesh decode_draco(std::string_view compressed, const std::vector<DracoAttribute>& wanted,
                       const DracoLimits& limits) try {
    draco::Mesh mesh;
    decode_mesh(compressed, limits, mesh);
    DracoMesh decoded{.vertices = mesh.num_points(), .indices = {}, .attributes = {}};
    decoded.indices.reserve(std::size_t{3} * mesh.num_faces());
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
            if (corner.value() >= mesh.num_points()) throw GltfError(std::string(invalid));
            decoded.indices.push_back(corner.value());
        }
    for (const DracoAttribute& attribute : wanted) decoded.attributes.push_back(rows_of(mesh, attribute));
    return decoded;
} catch (const std::bad_alloc&) {
    throw GltfError(std::string(invalid));
} catch (const std::length_error&) {
    throw GltfError(std::string(invalid));
}

}  // namespace phasetree::tracer::gltf
