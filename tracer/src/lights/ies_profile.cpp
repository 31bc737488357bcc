#include "lights/ies_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace phasetree::tracer {

namespace {

// More than any instrument measures. Limits the memory that a file can claim.
constexpr int most_angles = 1441;  // a quarter of a degree over a full turn

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool is_blank_in_line(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Removes the first line and returns it. Lines end with a line feed, a carriage return, or both.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
    return line;
}

// Reads numbers one by one and tracks the line. Numbers are separated by blanks, commas and line ends.
class Numbers {
  public:
    Numbers(std::string_view text, int line) : text_(text), line_(line) {}

    double next(std::string_view what) {
        skip_blanks();
        if (text_.empty()) throw error(fmt::format("the file ends before {}", what));
        const auto end = std::find_if(text_.begin(), text_.end(), is_blank);
        std::string_view word(text_.begin(), end);
        text_.remove_prefix(word.size());
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [rest, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc() || rest != word.data() + word.size() || !std::isfinite(value))
            throw error(fmt::format("{} must be a number", what));
        return value;
    }
    int whole(std::string_view what, int low, int high) {
        const double value = next(what);
        if (value != std::floor(value) || value < low || value > high)
            throw error(fmt::format("{} must be a whole number from {} to {}, but is {}", what, low, high, value));
        return static_cast<int>(value);
    }
    std::vector<double> list(std::string_view what, int count) {
        std::vector<double> values;
        for (int i = 0; i < count; ++i) values.push_back(next(what));
        return values;
    }
    // Throws if a number follows. Other text at the end is ignored.
    void finish(std::string_view last) {
        skip_blanks();
        double surplus = 0.0;
        if (std::from_chars(text_.data(), text_.data() + text_.size(), surplus).ec == std::errc::invalid_argument)
            return;
        throw error(fmt::format("a number follows {}, so there are more numbers than the file says", last));
    }
    std::runtime_error error(const std::string& message) const {
        // Decimal commas make two numbers of one, and mistakes are noticed only further on.
        const bool may_have_decimal_commas = has_blanks_ && has_commas_alone_;
        return std::runtime_error(
            fmt::format("line {}: {}{}", line_, message,
                        may_have_decimal_commas ? "; a comma separates numbers, so write decimal points" : ""));
    }

  private:
    static bool is_blank(char c) { return is_blank_in_line(c) || c == '\r' || c == '\n' || c == ','; }

    void skip_blanks() {
        const std::string_view before = text_;
        while (!text_.empty() && is_blank(text_.front())) {
            const bool ends_line = text_.front() == '\n' || (text_.front() == '\r' && !text_.starts_with("\r\n"));
            line_ += ends_line ? 1 : 0;
            text_.remove_prefix(1);
        }
        const std::string_view separator = before.substr(0, before.size() - text_.size());
        has_commas_alone_ = has_commas_alone_ || separator == ",";
        has_blanks_ = has_blanks_ || (!separator.empty() && std::ranges::all_of(separator, is_blank_in_line));
    }

    std::string_view text_;
    int line_;
    bool has_blanks_ = false, has_commas_alone_ = false;  // among the separators so far
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank_in_line(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank_in_line(text.back())) text.remove_suffix(1);
    return text;
}
bool is_word(std::string_view text, std::string_view upper_case) {
    return std::ranges::equal(text, upper_case, {}, [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
}

// The text after "TILT=" in a line; nullopt for any other line. The standards write it in upper case and without
// blanks, but not all programs do.
std::optional<std::string_view> tilt_in(std::string_view line) {
    constexpr std::string_view keyword = "TILT";
    line = trimmed(line);
    if (!is_word(line.substr(0, keyword.size()), keyword)) return std::nullopt;
    line = trimmed(line.substr(keyword.size()));
    if (!line.starts_with('=')) return std::nullopt;
    return trimmed(line.substr(1));
}

// Everything before the numbers, up to the line with TILT. Labels are free, and so are keywords such as [TEST],
// introduced in 1991. `tilt` is the value of TILT.
struct Heading {
    std::string_view tilt, rest;
    int lines;
};

Heading heading_of(std::string_view text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    for (int line = 1; !text.empty(); ++line)
        if (const auto tilt = tilt_in(take_line(text))) return {*tilt, text, line};
    throw std::runtime_error("it has no line TILT=…, so it is not an IES photometric file");
}

void check_increasing(const Numbers& numbers, std::span<const double> angles, std::string_view what) {
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (!(angles[i] > angles[i - 1]))
            throw numbers.error(fmt::format("{} must increase, but {} follows {}", what, angles[i], angles[i - 1]));
}

// Linear interpolation between two neighbouring angles: the index of the lower one, and the fraction towards the next.
std::pair<std::size_t, double> place_among(std::span<const double> angles, double angle) {
    if (angles.size() == 1) return {0, 0.0};
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto below = static_cast<std::size_t>(above - angles.begin()) - 1;
    return {below, std::clamp((angle - angles[below]) / (angles[below + 1] - angles[below]), 0.0, 1.0)};
}

}  // namespace

IesProfile::IesProfile(std::string_view text) {
    const Heading heading = heading_of(text);
    Numbers numbers(heading.rest, heading.lines + 1);
    if (is_word(heading.tilt, "INCLUDE")) {
        // How lamps dim when the luminaire is tilted. It is ignored: the luminaire is assumed to hang as it was
        // measured.
        (void)numbers.whole("the lamp's position", 1, 3);
        const int pairs = numbers.whole("the number of tilt angles", 1, most_angles);
        (void)numbers.list("a tilt", pairs);
        (void)numbers.list("the factor of a tilt angle", pairs);
    } else if (!is_word(heading.tilt, "NONE")) {
        throw std::runtime_error(fmt::format(
            "line {}: TILT must be NONE or INCLUDE; tilt data in a separate file are not supported", heading.lines));
    }
    (void)numbers.next("the number of lamps");
    (void)numbers.next("the lumens of a lamp");
    const double multiplier = numbers.next("the candela multiplier");
    const int verticals = numbers.whole("the number of vertical angles", 1, most_angles);
    const int horizontals = numbers.whole("the number of horizontal angles", 1, most_angles);
    const int type = numbers.whole("the photometric type", 1, 3);
    if (type != 1)
        throw numbers.error(fmt::format("the photometric type must be 1, which is C, but is {}, which is {}", type,
                                        type == 2 ? 'B' : 'A'));
    (void)numbers.whole("the unit of lengths", 1, 2);
    (void)numbers.list("a length of the luminous opening", 3);
    const double ballast = numbers.next("the ballast factor");
    (void)numbers.list("the input power", 2);
    vertical_ = numbers.list("a vertical angle", verticals);
    check_increasing(numbers, vertical_, "the vertical angles");
    if (vertical_.front() < 0.0 || vertical_.back() > 180.0)
        throw numbers.error("the vertical angles must be from 0 to 180");
    horizontal_ = numbers.list("a horizontal angle", horizontals);
    check_increasing(numbers, horizontal_, "the horizontal angles");
    const double last = horizontal_.back();
    if (horizontal_.front() != 0.0 || (last != 0.0 && last != 90.0 && last != 180.0 && last != 360.0))
        throw numbers.error(
            fmt::format("the horizontal angles must go from 0 to 0, 90, 180 or 360, but go from {} to {}",
                        horizontal_.front(), last));
    const double scale = multiplier * ballast;
    if (!(scale > 0.0)) throw numbers.error("the candela multiplier and the ballast factor must be positive");
    candelas_ = numbers.list("the candelas", verticals * horizontals);
    for (double& candelas : candelas_) {
        if (!(candelas >= 0.0)) throw numbers.error("candelas must not be negative");
        candelas *= scale;
        if (!std::isfinite(candelas))
            throw numbers.error(
                fmt::format("the candelas times {}, the product of their multiplier and the factor of "
                            "the ballast, are too large",
                            scale));
    }
    numbers.finish("the last of the candelas");
    greatest_ = *std::ranges::max_element(candelas_);
    if (!(greatest_ > 0.0)) throw numbers.error("all candelas are 0");
}

// The plane of the file that represents this one.
double IesProfile::symmetric(double horizontal_degrees) const {
    double angle = std::fmod(horizontal_degrees, 360.0);
    if (angle < 0.0) angle += 360.0;
    const double last = horizontal_.back();
    if (last <= 180.0 && angle > 180.0) angle = 360.0 - angle;
    if (last <= 90.0 && angle > 90.0) angle = 180.0 - angle;
    return angle;
}

float IesProfile::relative_intensity(double vertical_degrees, double horizontal_degrees) const {
    // A tenth of an arcsecond, for rounding at the ends.
    constexpr double slack = 3e-5;
    if (vertical_degrees < vertical_.front() - slack || vertical_degrees > vertical_.back() + slack) return 0.0f;
    const auto [row, down] = place_among(vertical_, vertical_degrees);
    const auto [plane, around] = place_among(horizontal_, symmetric(horizontal_degrees));
    const auto at = [&](std::size_t p, std::size_t r) {
        return candelas_[std::min(p, horizontal_.size() - 1) * vertical_.size() + std::min(r, vertical_.size() - 1)];
    };
    const double here = (1.0 - down) * at(plane, row) + down * at(plane, row + 1);
    const double beside = (1.0 - down) * at(plane + 1, row) + down * at(plane + 1, row + 1);
    return static_cast<float>(((1.0 - around) * here + around * beside) / greatest_);
}

}  // namespace phasetree::tracer
