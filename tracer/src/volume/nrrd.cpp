// Writes NRRD files (teem.sourceforge.net/nrrd/format.html). Keys that begin with "Segment" are those by which
// 3D Slicer names and colours the segments of a .seg.nrrd file.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "volume/label_volume.hpp"

namespace phasetree::tracer {

namespace {

// The value of a key, and a comment, must be on one line.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') result += "\\\\";
        if (c == '\n') result += "\\n";
        if (c == '\r') result += ' ';
        if (c != '\\' && c != '\n' && c != '\r') result += c;
    }
    return result;
}

std::string list_of_labels(const LabelVolume& v) {
    std::string text;
    for (std::size_t label = 1; label < v.phases.size(); ++label)
        text += fmt::format(", {} {}", label, escaped(v.phases[label].name));
    return text;
}

std::string header_of(const LabelVolume& v) {
    std::string text = "NRRD0005\n";
    text +=
        fmt::format("# Labels of phases at the centres of voxels: 0 vacuum{}\n# Coordinates are those of the scene{}\n",
                    list_of_labels(v), v.scale == 1 ? "" : fmt::format(", multiplied by {}", v.scale));
    text += "type: uint8\ndimension: 3\nspace: right-anterior-superior\n";
    text += fmt::format("sizes: {} {} {}\n", v.size[0], v.size[1], v.size[2]);
    text += fmt::format("space directions: ({0},0,0) (0,{0},0) (0,0,{0})\n", v.spacing);
    text += fmt::format("space origin: ({},{},{})\n", v.origin.x, v.origin.y, v.origin.z);
    if (!v.unit.empty()) text += fmt::format("space units: \"{0}\" \"{0}\" \"{0}\"\n", v.unit);
    text += "kinds: domain domain domain\ncenterings: cell cell cell\nencoding: gzip\n";
    for (std::size_t label = 1; label < v.phases.size(); ++label) {
        const LabelVolume::Phase& phase = v.phases[label];
        const std::string key = fmt::format("Segment{}", label - 1);
        text += fmt::format("{}_ID:=Segment_{}\n{}_Name:={}\n{}_LabelValue:={}\n{}_Layer:=0\n", key, label, key,
                            escaped(phase.name), key, label, key);
        text += fmt::format("{}_Color:={:.4f} {:.4f} {:.4f}\n", key, phase.color[0] / 255.0, phase.color[1] / 255.0,
                            phase.color[2] / 255.0);
        text += fmt::format("{}_Extent:=0 {} 0 {} 0 {}\n", key, v.size[0] - 1, v.size[1] - 1, v.size[2] - 1);
    }
    return text + "\n";
}

// Ends a stream of zlib at the end of its scope.
struct Deflate {
    z_stream stream{};
    Deflate() {
        constexpr int largest_window = 15, with_gzip_header = 16, memory_level = 8;
        if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, largest_window + with_gzip_header, memory_level,
                           Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    ~Deflate() { ::deflateEnd(&stream); }
    Deflate(const Deflate&) = delete;
    Deflate& operator=(const Deflate&) = delete;
};

}  // namespace

std::string labels_as_nrrd(const LabelVolume& volume, const std::function<bool()>& cancelled) {
    constexpr std::size_t chunk = std::size_t{1} << 20;
    std::string file = header_of(volume);
    Deflate deflate;
    z_stream& stream = deflate.stream;
    std::vector<unsigned char> compressed(chunk);
    for (std::size_t begin = 0; begin < volume.labels.size(); begin += chunk) {
        if (cancelled()) throw LabelsCancelled();
        const std::size_t count = std::min(chunk, volume.labels.size() - begin);
        stream.next_in = const_cast<Bytef*>(volume.labels.data() + begin);  // zlib does not write to it
        stream.avail_in = static_cast<uInt>(count);
        const int flush = begin + count == volume.labels.size() ? Z_FINISH : Z_NO_FLUSH;
        do {
            stream.next_out = compressed.data();
            stream.avail_out = static_cast<uInt>(compressed.size());
            ::deflate(&stream, flush);
            file.append(reinterpret_cast<const char*>(compressed.data()), compressed.size() - stream.avail_out);
        } while (stream.avail_out == 0);
    }
    return file;
}

}  // namespace phasetree::tracer
