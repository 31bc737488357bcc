#include "film/cryptomatte.hpp"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace phasetree::tracer {

namespace {

std::uint32_t mixed(std::uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

std::uint32_t byte_of(std::string_view bytes, std::size_t i) {
    return static_cast<unsigned char>(bytes[i]);
}

}  // namespace

std::uint32_t murmur_hash3_32(std::string_view bytes) {
    std::uint32_t hash = 0;
    const std::size_t blocks = bytes.size() / 4;
    for (std::size_t i = 0; i < blocks; ++i) {
        std::uint32_t block = 0;
        for (std::size_t j = 0; j < 4; ++j) block |= byte_of(bytes, 4 * i + j) << (8 * j);
        hash = std::rotl(hash ^ mixed(block), 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t i = 4 * blocks; i < bytes.size(); ++i) rest |= byte_of(bytes, i) << (8 * (i % 4));
    hash ^= mixed(rest);
    hash ^= static_cast<std::uint32_t>(bytes.size());
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
    return hash ^ (hash >> 16);
}

std::uint32_t cryptomatte_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash3_32(name), exponent = (hash >> 23) & 255;
    return exponent == 0 || exponent == 255 ? hash ^ (1u << 23) : hash;
}

std::vector<std::pair<std::string, std::string>> cryptomatte_attributes(const std::string& layer,
                                                                        const std::vector<std::string>& names) {
    nlohmann::ordered_json manifest = nlohmann::ordered_json::object();
    for (const std::string& name : names) manifest[name] = fmt::format("{:08x}", cryptomatte_id(name));
    const std::string key = "cryptomatte/" + fmt::format("{:08x}", cryptomatte_id(layer)).substr(0, 7) + "/";
    return {{key + "name", layer},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            // Names come from scenes, which are UTF-8, or from parts, which may contain any bytes.
            {key + "manifest", manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)}};
}

}  // namespace phasetree::tracer
