// Validates a value against a JSON Schema (draft 7). Supports only what the schema of scene files uses.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "phasetree/io/document.hpp"

namespace phasetree::tests {

class JsonSchema {
  public:
    explicit JsonSchema(std::string text) : document_(Document::from_text(std::move(text), "the schema")) {}

    Value root() const { return document_.root(); }
    Value definition(std::string_view name) const { return *definitions().find(name); }

    /// Returns an empty string if the value is valid, otherwise what is wrong, and with which key.
    std::string mistake(Value value) const { return mistake(root(), value); }
    std::string mistake(Value schema, Value value) const {
        for (const Value rule : schema)
            if (std::string wrong = broken(schema, rule, value); !wrong.empty())
                return wrong + " (" + std::string(value.key()) + ")";
        return {};
    }

  private:
    Value definitions() const { return *root().find("definitions"); }
    // The value at a path such as "material/properties/clear".
    static Value at_path(Value value, std::string_view path) {
        const std::size_t end = path.find('/');
        const Value inner = *value.find(path.substr(0, end));
        return end == path.npos ? inner : at_path(inner, path.substr(end + 1));
    }

    static bool is_of(std::string_view type, Value value) {
        if (type == "integer") return value.is_number() && value.number() == std::trunc(value.number());
        return (type == "number" && value.is_number()) || (type == "string" && value.is_string()) ||
               (type == "boolean" && value.is_boolean()) || (type == "array" && value.is_array()) ||
               (type == "object" && value.is_object());
    }

    static bool are_equal(Value a, Value b) {
        if (a.kind() != b.kind()) return false;
        return a.is_string() ? a.string() == b.string() : a.is_number() && a.number() == b.number();
    }

    static bool is_hexadecimal_colour(std::string_view text) {
        return text.size() == 7 && text[0] == '#' &&
               text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
    }

    std::string broken(Value schema, Value rule, Value value) const {
        const std::string key(rule.key());
        const auto told = [&](bool is_kept) { return is_kept ? std::string() : "breaks " + key; };
        const auto bound = [&](auto compare) {
            return told(!value.is_number() || compare(value.number(), rule.number()));
        };
        const auto count = [&](bool applies, auto compare) {
            return told(!applies || compare(static_cast<double>(value.size()), rule.number()));
        };
        if (key == "type") return told(is_of(rule.string(), value));
        if (key == "const") return told(are_equal(rule, value));
        if (key == "minimum") return bound(std::greater_equal());
        if (key == "exclusiveMinimum") return bound(std::greater());
        if (key == "maximum") return bound(std::less_equal());
        if (key == "exclusiveMaximum") return bound(std::less());
        if (key == "minItems") return count(value.is_array(), std::greater_equal());
        if (key == "maxItems") return count(value.is_array(), std::less_equal());
        if (key == "minProperties") return count(value.is_object(), std::greater_equal());
        if (key == "maxProperties") return count(value.is_object(), std::less_equal());
        if (key == "minLength")
            return told(!value.is_string() || static_cast<double>(value.string().size()) >= rule.number());
        if (key == "pattern") {
            if (rule.string() != "^#[0-9a-fA-F]{6}$") throw std::logic_error("a pattern that the test does not know");
            return told(!value.is_string() || is_hexadecimal_colour(value.string()));
        }
        if (key == "enum") {
            for (const Value one : rule)
                if (are_equal(one, value)) return {};
            return told(false);
        }
        if (key == "$ref") {
            const std::string_view begin = "#/definitions/";
            if (!rule.string().starts_with(begin)) throw std::logic_error("a reference to elsewhere");
            return mistake(at_path(definitions(), rule.string().substr(begin.size())), value);
        }
        if (key == "anyOf") {
            std::string all;
            for (const Value one : rule) {
                const std::string wrong = mistake(one, value);
                if (wrong.empty()) return {};
                all += (all.empty() ? "" : "; or ") + wrong;
            }
            return all;
        }
        if (key == "items" && rule.is_array()) {  // one schema for each
            for (std::size_t i = 0; value.is_array() && i < std::min(rule.size(), value.size()); ++i)
                if (std::string wrong = mistake(rule[i], value[i]); !wrong.empty()) return wrong;
            return {};
        }
        if (key == "allOf" || (key == "items" && value.is_array())) {
            const Value& list = key == "items" ? value : rule;
            for (const Value one : list)
                if (std::string wrong = key == "items" ? mistake(rule, one) : mistake(one, value); !wrong.empty())
                    return wrong;
            return {};
        }
        if (key == "required") {
            for (const Value one : rule)
                if (value.is_object() && !value.find(one.string())) return "lacks " + std::string(one.string());
            return {};
        }
        if (key == "properties" || key == "additionalProperties") return of_members(schema, rule, value);
        if (key == "$schema" || key == "title" || key == "description" || key == "default" || key == "definitions" ||
            key == "items")
            return {};
        throw std::logic_error("a rule that the test does not know: " + key);
    }

    std::string of_members(Value schema, Value rule, Value value) const {
        if (!value.is_object()) return {};
        const auto properties = schema.find("properties");
        const bool are_listed = rule.key() == "properties";
        for (const Value member : value) {
            const auto property = properties ? properties->find(member.key()) : std::nullopt;
            std::string wrong;
            if (are_listed) {
                if (property) wrong = mistake(*property, member);
            } else if (!property) {
                if (rule.is_boolean() && !rule.boolean()) wrong = "has the key " + std::string(member.key());
                if (rule.is_object()) wrong = mistake(rule, member);
            }
            if (!wrong.empty()) return wrong;
        }
        return {};
    }

    Document document_;
};

}  // namespace phasetree::tests
