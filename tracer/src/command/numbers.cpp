#include "command/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <istream>

namespace phasetree::tracer {

void for_each_line_of_numbers(std::istream& in, std::size_t count,
                              const std::function<void(const std::array<float, 6>&, std::size_t)>& use) {
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        const char* p = line.data();
        const char* const end = p + line.size();
        const auto skip = [&] {
            while (p != end && (*p == ' ' || *p == '\t' || *p == ',' || *p == '\r')) ++p;
        };
        skip();
        if (p == end || *p == '#') continue;
        std::array<float, 6> values{};
        for (std::size_t i = 0; i < count; ++i) {
            const auto [rest, error] = std::from_chars(p, end, values[i]);
            if (error != std::errc() || !std::isfinite(values[i]))
                throw InputError(
                    fmt::format("<stdin>:{}:{}: expected {} finite numbers", number, p - line.data() + 1, count));
            p = rest;
            skip();
        }
        if (p != end)
            throw InputError(fmt::format("<stdin>:{}:{}: more than {} numbers", number, p - line.data() + 1, count));
        use(values, number);
    }
}

}  // namespace phasetree::tracer
