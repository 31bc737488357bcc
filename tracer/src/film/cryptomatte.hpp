// Cryptomatte's encoding of names, IDs and file attributes (Friedman & Jones: Fully automatic ID mattes with support
// for motion blur and transparency, SIGGRAPH 2015 posters; the specification is Psyop's, version 1.2).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace phasetree::tracer {

/// MurmurHash3_x86_32 with the seed 0 (Austin Appleby, 2011).
std::uint32_t murmur_hash3_32(std::string_view bytes);

/// The bits of the float that represents a name: its hash, with the lowest bit of the exponent flipped if all bits of
/// the exponent are equal, so that it is a normal number.
std::uint32_t cryptomatte_id(std::string_view name);

/// The EXR attributes that describe a layer: its name, the conversion of names to IDs, and the manifest.
std::vector<std::pair<std::string, std::string>> cryptomatte_attributes(const std::string& layer,
                                                                        const std::vector<std::string>& names);

}  // namespace phasetree::tracer
