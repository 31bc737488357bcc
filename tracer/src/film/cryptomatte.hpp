// What Cryptomatte says of names, numbers and files (Friedman & Jones: Fully automatic ID mattes with support for
// motion blur and transparency, SIGGRAPH 2015 posters; the specification is Psyop's, version 1.2).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace phasetree::tracer {

/// MurmurHash3_x86_32 with the seed 0 (Austin Appleby, 2011).
std::uint32_t murmur_hash3_32(std::string_view bytes);

/// The bits of the float that stands for a name: its hash, with the lowest bit of the exponent flipped where all of the
/// exponent's bits are equal, so that it is an ordinary number.
std::uint32_t cryptomatte_id(std::string_view name);

/// The attributes by which an EXR file tells of a layer: its name, how names become numbers, and which there are.
std::vector<std::pair<std::string, std::string>> cryptomatte_attributes(const std::string& layer,
                                                                        const std::vector<std::string>& names);

}  // namespace phasetree::tracer
