#include "studio/rebase.hpp"

#include <fmt/format.h>

#include "studio/edited_document.hpp"
#include "studio/layout.hpp"
#include "studio/pointer.hpp"

namespace phasetree::tracer::studio {

namespace {

void check_pointer(const Document& base, const Document& present, const std::string& pointer, bool must_be_same) {
    Value before = base.root(), now = present.root();
    for (const std::string& token : pointer_tokens(pointer)) {
        if (before.is_array() && (!now.is_array() || before.size() != now.size()))
            throw ConflictError(
                fmt::format("a list on the way to {} has changed since; read the document again", pointer));
        const std::optional<Value> next_before = child_of(before, token), next_now = child_of(now, token);
        if (!next_before || !next_now) return;  // for the operation itself to reject
        before = *next_before;
        now = *next_now;
    }
    if (must_be_same && span_of(base, before).of(base.text()) != span_of(present, now).of(present.text()))
        throw ConflictError(fmt::format("{} has changed since; read the document again", pointer));
}

}  // namespace

void check_rebase(const Document& base, const Document& present, std::span<const Operation> operations) {
    for (const Operation& operation : operations) {
        if (std::holds_alternative<ReplaceText>(operation))
            throw ConflictError("the text has changed since; read the document again");
        std::visit(
            [&]<class O>(const O& o) {
                if constexpr (requires { o.pointer; }) {
                    constexpr bool ignores_old_value = std::is_same_v<O, SetValue> || std::is_same_v<O, InsertValue>;
                    check_pointer(base, present, o.pointer, !ignores_old_value);
                    if constexpr (std::is_same_v<O, MoveValue>) check_pointer(base, present, o.to, false);
                }
            },
            operation);
    }
}

}  // namespace phasetree::tracer::studio
