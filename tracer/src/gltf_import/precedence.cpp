#include "gltf_import/precedence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <tuple>

namespace phasetree::tracer::gltf_import {

namespace {

struct KnownWord {
    std::string_view word;
    Matter matter;
};

// A final s or es is ignored, so plurals are recognised.
constexpr std::array known_words{
    KnownWord{"glass", Matter::solid},      KnownWord{"ice", Matter::solid},      KnownWord{"cube", Matter::solid},
    KnownWord{"straw", Matter::solid},      KnownWord{"crystal", Matter::solid},  KnownWord{"plastic", Matter::solid},
    KnownWord{"bottle", Matter::solid},     KnownWord{"cup", Matter::solid},      KnownWord{"mug", Matter::solid},
    KnownWord{"jar", Matter::solid},        KnownWord{"vase", Matter::solid},     KnownWord{"bowl", Matter::solid},
    KnownWord{"tumbler", Matter::solid},    KnownWord{"goblet", Matter::solid},   KnownWord{"carafe", Matter::solid},
    KnownWord{"flask", Matter::solid},      KnownWord{"tube", Matter::solid},     KnownWord{"lens", Matter::solid},
    KnownWord{"prism", Matter::solid},      KnownWord{"gem", Matter::solid},      KnownWord{"diamond", Matter::solid},
    KnownWord{"acrylic", Matter::solid},    KnownWord{"window", Matter::solid},   KnownWord{"jelly", Matter::solid},
    KnownWord{"water", Matter::liquid},     KnownWord{"liquid", Matter::liquid},  KnownWord{"fluid", Matter::liquid},
    KnownWord{"juice", Matter::liquid},     KnownWord{"wine", Matter::liquid},    KnownWord{"beer", Matter::liquid},
    KnownWord{"milk", Matter::liquid},      KnownWord{"tea", Matter::liquid},     KnownWord{"coffee", Matter::liquid},
    KnownWord{"lemonade", Matter::liquid},  KnownWord{"soda", Matter::liquid},    KnownWord{"cola", Matter::liquid},
    KnownWord{"tonic", Matter::liquid},     KnownWord{"drink", Matter::liquid},   KnownWord{"cocktail", Matter::liquid},
    KnownWord{"whisky", Matter::liquid},    KnownWord{"whiskey", Matter::liquid}, KnownWord{"vodka", Matter::liquid},
    KnownWord{"gin", Matter::liquid},       KnownWord{"rum", Matter::liquid},     KnownWord{"cider", Matter::liquid},
    KnownWord{"champagne", Matter::liquid}, KnownWord{"lager", Matter::liquid},   KnownWord{"ale", Matter::liquid},
    KnownWord{"oil", Matter::liquid},       KnownWord{"honey", Matter::liquid},   KnownWord{"syrup", Matter::liquid},
    KnownWord{"vinegar", Matter::liquid},   KnownWord{"alcohol", Matter::liquid}, KnownWord{"ethanol", Matter::liquid},
    KnownWord{"ink", Matter::liquid},       KnownWord{"sea", Matter::liquid},     KnownWord{"ocean", Matter::liquid},
    KnownWord{"puddle", Matter::liquid},    KnownWord{"drop", Matter::liquid},    KnownWord{"droplet", Matter::liquid},
    KnownWord{"air", Matter::gas},          KnownWord{"bubble", Matter::gas},     KnownWord{"gas", Matter::gas},
    KnownWord{"vacuum", Matter::gas}};

std::optional<Matter> matter_of_word(std::string_view word) {
    const auto find = [](std::string_view w) { return std::ranges::find(known_words, w, &KnownWord::word); };
    auto found = find(word);
    if (found == known_words.end() && word.ends_with('s')) found = find(word.substr(0, word.size() - 1));
    if (found == known_words.end() && word.ends_with("es")) found = find(word.substr(0, word.size() - 2));
    return found == known_words.end() ? std::nullopt : std::optional(found->matter);
}

// The words of a name in lower case; a capital after a small letter begins a new word.
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words(1);
    bool was_small = false;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        const bool is_letter = code < 0x80 && std::isalpha(code) != 0,
                   is_capital = is_letter && std::isupper(code) != 0;
        if ((!is_letter || (is_capital && was_small)) && !words.back().empty()) words.emplace_back();
        if (is_letter) words.back() += static_cast<char>(std::tolower(code));
        was_small = is_letter && !is_capital;
    }
    return words;
}

std::optional<Matter> matter_of_name(std::string_view name) {
    std::optional<Matter> matter;
    for (const std::string& word : words_of(name)) {
        if (matter && (word == "of" || word == "in" || word == "with")) break;
        if (const auto known = matter_of_word(word)) matter = known;
    }
    return matter;
}

class Order {
  public:
    Order(const std::vector<Solid>& solids, const std::vector<Matter>& matter)
        : solids_(solids), matter_(matter), below_(solids.size()), above_(solids.size(), 0) {}

    Decision decide(const Contact& c) const {
        const std::size_t a = c.first, b = c.second;
        const float pa = priority(a), pb = priority(b);
        if (pa != pb) return {pa > pb ? a : b, pa > pb ? b : a, "higher phasetree_priority", 1};
        if (c.is_first_inside) return {a, b, "within the other", 2};
        if (c.is_second_inside) return {b, a, "within the other", 2};
        if (matter_[a] != matter_[b]) {
            const bool first = matter_[a] < matter_[b];
            const std::size_t winner = first ? a : b, loser = first ? b : a;
            return {winner, loser, fmt::format("{} over {}", name_of(matter_[winner]), name_of(matter_[loser])), 3};
        }
        return {a, b, "earlier in the file", 4};
    }

    // False if earlier decisions imply the opposite.
    bool add(const Decision& d) {
        if (is_above(d.loser, d.winner)) return false;
        below_[d.winner].push_back(d.loser);
        ++above_[d.loser];
        return true;
    }

    // Winners first. Solids of the same material follow each other where the decisions allow it.
    std::vector<std::size_t> sorted() {
        std::vector<std::size_t> order;
        std::vector<bool> is_taken(solids_.size(), false);
        while (order.size() < solids_.size()) {
            std::optional<std::size_t> next;
            const auto key = [&](std::size_t i) {
                const bool continues = !order.empty() && solids_[i].material == solids_[order.back()].material;
                return std::tuple(!continues, -priority(i), matter_[i], i);
            };
            for (std::size_t i = 0; i < solids_.size(); ++i)
                if (!is_taken[i] && above_[i] == 0 && (!next || key(i) < key(*next))) next = i;
            is_taken[*next] = true;
            order.push_back(*next);
            for (const std::size_t loser : below_[*next]) --above_[loser];
        }
        return order;
    }

  private:
    float priority(std::size_t i) const { return solids_[i].priority.value_or(0); }

    bool is_above(std::size_t from, std::size_t to) const {
        std::vector<std::size_t> next{from};
        std::vector<bool> was_met(solids_.size(), false);
        while (!next.empty()) {
            const std::size_t i = next.back();
            next.pop_back();
            if (i == to) return true;
            if (was_met[i]) continue;
            was_met[i] = true;
            next.insert(next.end(), below_[i].begin(), below_[i].end());
        }
        return false;
    }

    const std::vector<Solid>& solids_;
    const std::vector<Matter>& matter_;
    std::vector<std::vector<std::size_t>> below_;  // the solids that each solid replaces
    std::vector<std::size_t> above_;               // the number of solids that replace it
};

}  // namespace

std::string_view name_of(Matter matter) {
    return matter == Matter::solid ? "solid" : matter == Matter::gas ? "gas" : "liquid";
}

std::optional<Matter> matter_named(std::string_view name) {
    for (const Matter matter : {Matter::solid, Matter::gas, Matter::liquid})
        if (name_of(matter) == name) return matter;
    return std::nullopt;
}

Matter matter_of(std::string_view object, std::string_view material, float ior) {
    if (ior < 1.1f) return Matter::gas;
    if (const auto matter = matter_of_name(object)) return *matter;
    if (const auto matter = matter_of_name(material)) return *matter;
    return ior >= 1.32f && ior <= 1.4f ? Matter::liquid : Matter::solid;
}

Precedence precedence_of(const std::vector<Solid>& solids, const std::vector<Matter>& matter,
                         const std::vector<Contact>& contacts) {
    Precedence made;
    Order order(solids, matter);
    for (const Contact& contact : contacts)
        if (contact.overlap()) made.decisions.push_back(order.decide(contact));
    for (int rule = 1; rule <= 4; ++rule)
        for (Decision& d : made.decisions) {
            if (d.rule != rule || order.add(d)) continue;
            if (solids[d.winner].material != solids[d.loser].material)
                made.warnings.push_back(
                    fmt::format("\"{}\" replaces \"{}\" where they overlap, although the rule ({}) says otherwise, "
                                "because of overlaps with other objects; set a phasetree_priority to choose",
                                solids[d.loser].name, solids[d.winner].name, d.reason));
            std::swap(d.winner, d.loser);
            d.reason = "to be consistent with other overlaps";
        }
    made.order = order.sorted();
    return made;
}

}  // namespace phasetree::tracer::gltf_import
