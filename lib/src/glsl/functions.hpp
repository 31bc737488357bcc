#pragma once

#include <map>
#include <string>
#include <vector>

#include "glsl/function_text.hpp"

namespace phasetree::glsl {

/// The functions that the instructions of some programs need. Instructions of one kind whose equations take the same
/// way share a function: what differs between them are numbers, which the function finds from the offset `at` on. A
/// number that is the same in all of them stands in the text.
class Functions {
  public:
    /// Returns the number of an instruction, which others that are equal share.
    std::uint32_t add(Op, std::span<const float> constants);
    /// Gives all numbers their offsets; nothing may be added after that.
    void finish();

    /// What is called for an instruction. `arguments` are x, y, z or those that the operation takes.
    std::string call(std::uint32_t instruction, std::span<const std::string> arguments, bool with_gradients) const;
    std::uint32_t function(std::uint32_t instruction) const { return instances_[instruction].function; }
    std::uint32_t at(std::uint32_t instruction) const { return instances_[instruction].at; }
    std::size_t count() const { return functions_.size(); }
    /// How many numbers a function takes, and whether it gives a point.
    Op operation(std::uint32_t function) const { return functions_[function].op; }
    /// A call of a function whose numbers are at the offset that `at` says.
    std::string call_at(std::uint32_t function, std::span<const std::string> arguments, const std::string& at,
                        bool with_gradients) const;
    /// The definitions of all functions.
    std::string text(bool with_gradients) const;
    /// What pt_number(i) must return.
    const std::vector<float>& numbers() const { return numbers_; }

  private:
    /// Floats as they lie in memory: −0 is not 0.
    using Bits = std::vector<std::uint32_t>;
    struct Function {
        Op op{};
        std::string name;
        FunctionText text;  // its slots are those of the first instance
        bool takes_offset = false;
        std::vector<std::string> slot_texts;
        std::string lookup_offset;
    };
    struct Instance {
        std::uint32_t function = 0;
        std::uint32_t at = 0;
        std::vector<NumberSlot> slots;
        std::vector<float> data;
    };
    void assign_offsets(std::uint32_t function);
    std::uint32_t offset_of_block(const std::vector<float>& block);
    std::string filled(const Function&, const std::string& text) const;

    std::vector<Function> functions_;
    std::vector<Instance> instances_;
    std::map<std::pair<Op, Bits>, std::uint32_t> known_;
    std::map<std::pair<Op, std::string>, std::uint32_t> shapes_;
    std::map<std::string, std::uint32_t> names_;
    std::map<Bits, std::uint32_t> blocks_;
    std::vector<float> numbers_;
};

}  // namespace phasetree::glsl
