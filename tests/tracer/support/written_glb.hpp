// A .glb file written by a test: the document as text, and numbers for its bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace phasetree::tests {

/// The bytes after a document; each part begins at a multiple of four.
class GlbBytes {
  public:
    /// Returns the part's text for the list "bufferViews".
    template <class Number>
    std::string add(const std::vector<Number>& numbers, const std::string& more = "") {
        return add(std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)), more);
    }
    std::string add(const std::string& bytes, const std::string& more = "") {
        const std::string view = "{\"buffer\": 0, \"byteOffset\": " + std::to_string(bytes_.size()) +
                                 ", \"byteLength\": " + std::to_string(bytes.size()) + more + "}";
        bytes_ += bytes;
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        return view;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

inline std::string glb_chunk(std::uint32_t type, std::string content, char filler) {
    content.resize((content.size() + 3) / 4 * 4, filler);
    const std::uint32_t head[2] = {static_cast<std::uint32_t>(content.size()), type};
    return std::string(reinterpret_cast<const char*>(head), sizeof head) + content;
}

/// `document` is the whole document except "asset" and "buffers".
inline std::string glb(const std::string& document, const std::string& bytes, std::uint32_t version = 2) {
    const std::string all =
        "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": " + std::to_string(bytes.size()) + "}], " +
        document + "}";
    const std::string chunks = glb_chunk(0x4E4F534A, all, ' ') + glb_chunk(0x004E4942, bytes, '\0');
    const std::uint32_t head[3] = {0x46546C67, version, static_cast<std::uint32_t>(12 + chunks.size())};
    return std::string(reinterpret_cast<const char*>(head), sizeof head) + chunks;
}

}  // namespace phasetree::tests
