#pragma once

#include <string>

namespace phasetree::tracer::tests {

/// A scene without lights.
inline const std::string dark = R"("lights": [])";

/// A shape of the phase "hot", moved to a point.
inline std::string hot(const std::string& shape, const std::string& at = "[0, 0, 0]") {
    return R"({"set": {"phase": "hot", "of": {"translate": {"by": )" + at + R"(, "of": )" + shape + "}}}}";
}
/// The phase "hot", which glows; `more` adds parameters to its material.
inline std::string glowing(const std::string& more = "") {
    return R"("hot": {"glowing": {"light": [1, 0.5, 0.25], "radiance": 8)" + more + "}}";
}

}  // namespace phasetree::tracer::tests
