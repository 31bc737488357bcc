// The accessors of a document, and data that is computed only once for all of their readers: the bytes of compressed
// buffer views and primitives, and which lists of sparse accessors have been checked.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gltf/accessor.hpp"
#include "gltf/document.hpp"
#include "gltf/draco.hpp"

namespace phasetree::tracer::gltf {

class Accessors {
  public:
    /// Refers to the document. `max_triangles` limits the triangles of a compressed primitive.
    Accessors(const Document& document, std::size_t max_triangles)
        : document_(document), most_triangles_(max_triangles) {}

    const Document& document() const { return document_; }
    Accessor read(std::size_t index, const Item& from) { return Accessor(*this, index, from); }
    /// All bytes of an element of "bufferViews", decoded if they are compressed.
    std::string_view bytes_of_view(std::size_t index, const Item& from);
    /// Whether the `count` indices of that sparse accessor still have to be checked; false from the second call on.
    bool must_check(std::size_t accessor, std::size_t count);
    /// The content of KHR_draco_mesh_compression of a primitive: an accessor for each attribute that is read, and one
    /// called "indices". Empty if the primitive is not compressed, or if the build cannot decode it but the file has an
    /// uncompressed copy.
    std::map<std::string, Accessor> decoded(const Item& primitive, const Item& attributes);

  private:
    using DracoKey = std::pair<std::size_t, std::vector<DracoAttribute>>;

    // Counts decoded bytes, together with the compressed bytes from which they were decoded.
    void count(std::size_t bytes);

    const Document& document_;
    std::size_t most_triangles_;
    std::size_t bytes_left_ = std::size_t{1} << 30;
    std::size_t indices_left_ = 200'000'000;
    std::map<std::size_t, std::string> views_;  // the decoded ones
    std::map<DracoKey, DracoMesh> primitives_;  // by view and attributes that are read
    std::set<std::size_t> checked_;
};

}  // namespace phasetree::tracer::gltf
