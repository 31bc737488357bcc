#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree {

/// Values that change with time. Scene files write them as {"keys": [[0, 1], [2.5, 3]]}: pairs of a time in seconds and
/// a value, with increasing times. The value is constant before the first key and after the last one.
///
/// "between" selects the interpolation: "linear", or "smooth", which starts and ends slowly (3s² − 2s³ for a fraction s
/// of the interval).
class Keys {
  public:
    static constexpr std::size_t most = 100'000;  ///< the maximum number of keys

    /// Whether a value is keyed: an object with a member "keys".
    static bool are_in(Value value) { return value.find("keys").has_value(); }

    /// Check everything but the keyed values, which the caller reads. Throws SceneError. `what` names the value in
    /// messages; see as().
    Keys(const Document&, Value value, std::string_view what);

    std::size_t count() const { return list_.size(); }
    double seconds(std::size_t i) const { return list_[i][0].number(); }
    Value value(std::size_t i) const { return list_[i][1]; }

    /// The position of a time between two keys. The value lies the fraction `share`, in [0, 1), of the way from key
    /// `before` to the next one; "smooth" is already applied to it. Before the first key and from the last one on,
    /// `share` is 0.
    struct Place {
        std::size_t before;
        double share;
    };
    Place at(double seconds) const;

  private:
    Value list_;
    bool is_smooth_ = false;
};

/// The times of all keys within a value, unsorted and possibly repeated.
std::vector<double> times_of_keys(Value value);

/// The JSON Schema, as text, of {"keys": …} with values of any type.
std::string schema_of_keys();
/// The schema of a value that may be written plainly or as keys.
std::string schema_of_keyed(const std::string& schema);

}  // namespace phasetree
