#pragma once

#include <map>
#include <string>
#include <vector>

#include "glsl/function_text.hpp"

namespace phasetree::glsl {

/// The functions required by the instructions of some programs. Instructions of one kind whose equations take the same
/// branches share a function. They differ only in numbers, which the function reads from the offset `at` on. A number
/// that is the same for all of them becomes a literal.
class Functions {
  public:
    /// Returns the index of an instruction; equal instructions share an index.
    std::uint32_t add(Op, std::span<const float> constants);
    /// Assigns offsets to all numbers. Nothing may be added afterwards.
    void finish();

    /// The text of a call for an instruction. `arguments` are x, y and z, or the operation's operands.
    std::string call(std::uint32_t instruction, std::span<const std::string> arguments, bool with_gradients) const;
    std::uint32_t function(std::uint32_t instruction) const { return instances_[instruction].function; }
    std::uint32_t at(std::uint32_t instruction) const { return instances_[instruction].at; }
    std::size_t count() const { return functions_.size(); }
    /// The operation of a function, which determines its operands and whether it returns a point.
    Op operation(std::uint32_t function) const { return functions_[function].op; }
    /// The text of a call of a function whose numbers are at the offset given by the expression `at`.
    std::string call_at(std::uint32_t function, std::span<const std::string> arguments, const std::string& at,
                        bool with_gradients) const;
    /// The definitions of all functions.
    std::string text(bool with_gradients) const;
    /// The values that pt_number(i) must return.
    const std::vector<float>& numbers() const { return numbers_; }

  private:
    /// The bit patterns of floats, so that −0 differs from 0.
    using Bits = std::vector<std::uint32_t>;
    struct Function {
        Op op{};
        std::string name;
        FunctionText text;  // with the slots of the first instance
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
