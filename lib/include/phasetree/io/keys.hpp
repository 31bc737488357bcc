#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree {

/// What changes with time, as scene files write it: {"keys": [[0, 1], [2.5, 3]]}, where each key is a time in seconds,
/// later than the one before, and what is there then. Before the first key it is as at the first, and after the last as
/// at the last. "between" says how it goes from one to the next: "linear", or "smooth", which starts and ends slowly
/// (3s² − 2s³ of the way, after the share s of the time).
class Keys {
  public:
    static constexpr std::size_t most = 100'000;

    /// Whether a value is meant as keys: an object that has "keys".
    static bool are_in(Value value) { return value.find("keys").has_value(); }

    /// SceneError if something is wrong with them but for the values, which are for the caller to read. `what` names
    /// what they stand for, as in as().
    Keys(const Document&, Value value, std::string_view what);

    std::size_t count() const { return list_.size(); }
    double seconds(std::size_t i) const { return list_[i][0].number(); }
    Value value(std::size_t i) const { return list_[i][1]; }

    /// Where a time is: between the key `before` and the one after it, by a share in [0, 1). Of the last key the share
    /// is 0.
    struct Place {
        std::size_t before;
        double share;
    };
    Place at(double seconds) const;

  private:
    Value list_;
    bool is_smooth_ = false;
};

/// The times of all keys within a value, in any order, some more than once.
std::vector<double> times_of_keys(Value value);

/// JSON Schemas as text: of keys whatever their values, and of a value or keys of such.
std::string schema_of_keys();
std::string schema_of_keyed(const std::string& schema);

}  // namespace phasetree
