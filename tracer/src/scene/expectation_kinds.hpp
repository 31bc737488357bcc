// The kinds of statements in "expect" of a scene file: one list, which drives the reader, the reference and the schema.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "phasetree/io/parameter_type.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/prove.hpp"
#include "phasetree/model/concepts.hpp"
#include "scene/length_unit.hpp"

namespace phasetree {

// A name, or a list of names.
template <>
struct ParameterType<std::vector<std::string>, Parameter> {
    static std::vector<std::string> read(const Document& document, Value value, std::string_view what,
                                         const Parameter&) {
        if (value.is_string()) return {std::string(value.string())};
        return as<std::vector<std::string>>(document, value, what);
    }
    static ValueType describe(const Parameter&) {
        return {"text or list of texts",
                R"({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]})"};
    }
    static std::string written(const std::vector<std::string>&) { return "none"; }
};

}  // namespace phasetree

namespace phasetree::tracer {

// What statements refer to.
struct ExpectationContext {
    const PhaseNames& names;
    double metres = 1;                                    // of the scene's unit of length
    const std::vector<std::optional<double>>& densities;  // by phase, in kg/m³
};

// A statement, and the unit in which its volume or mass is printed.
struct MadeStatement {
    Statement statement;
    double unit = 1;  // its size, in the unit of the statement's limits
    std::string unit_name{};
};

std::vector<std::string_view> names_of_volume_units();
std::vector<std::string_view> names_of_mass_units();

inline constexpr Parameter expected_phase{"phase", "", "Name of the phase."};
inline constexpr Parameter two_phases{"phases", "", "Names of the two phases."};

struct PresentParameters {
    static constexpr KindInfo info{"present", "Some point has this phase."};
    std::string phase{};

    template <class V>
    static void parameters(V&& v) {
        v(&PresentParameters::phase, expected_phase);
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct ConnectedParameters {
    static constexpr KindInfo info{"connected", "The phase is in one piece."};
    std::string phase{};

    template <class V>
    static void parameters(V&& v) {
        v(&ConnectedParameters::phase, expected_phase);
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct ClosedParameters {
    static constexpr KindInfo info{
        "closed",
        "The walls have no hole: every path from a phase inside to the space around the object crosses a wall."};
    std::vector<std::string> walls{}, around{};

    template <class V>
    static void parameters(V&& v) {
        using P = ClosedParameters;
        v(&P::walls, Parameter{"walls", "", "Name of the phase that is the wall, or names of several."});
        v(&P::around, Parameter{"around", "", "Name of the phase inside, or names of several."});
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct ApartParameters {
    static constexpr KindInfo info{"apart", "The two phases do not touch, and keep a distance."};
    std::vector<std::string> phases{};
    double at_least = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = ApartParameters;
        v(&P::phases, two_phases);
        v(&P::at_least,
          Parameter{"at_least", "m", "The least distance between points of the phases.", limits::non_negative, true});
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct TouchingParameters {
    static constexpr KindInfo info{"touching", "The two phases touch somewhere."};
    std::vector<std::string> phases{};

    template <class V>
    static void parameters(V&& v) {
        v(&TouchingParameters::phases, two_phases);
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct WallParameters {
    static constexpr KindInfo info{
        "wall",
        "The phase is nowhere thinner: every point of it is within reach of the centre of a ball of this diameter that "
        "lies in the phase."};
    std::string phase{};
    double at_least = 0;
    std::optional<double> reach{};

    template <class V>
    static void parameters(V&& v) {
        using P = WallParameters;
        v(&P::phase, expected_phase);
        v(&P::at_least, Parameter{"at_least", "m", "The diameter.", limits::positive});
        v(&P::reach, Parameter{"reach", "m",
                               "More than half of the diameter; by default, the diameter, with which edges and corners "
                               "sharper than 60° count as too thin. A smaller reach finds smaller dents, but blunter "
                               "edges and corners then count as too thin as well.",
                               limits::positive, true});
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct VolumeParameters {
    static constexpr KindInfo info{"volume", "The volume of a phase, or of several together, is within limits."};
    std::vector<std::string> phase{};
    std::optional<double> at_least{}, at_most{};
    std::optional<std::string> unit{};

    template <class V>
    static void parameters(V&& v) {
        using P = VolumeParameters;
        v(&P::phase, Parameter{"phase", "", "Name of the phase, or names of several."});
        v(&P::at_least, Parameter{"at_least", "", "The lower limit.", limits::non_negative, true});
        v(&P::at_most, Parameter{"at_most", "", "The upper limit.", limits::non_negative, true});
        v(&P::unit,
          ChoiceParameter{{"unit", "", "Unit of the limits; by default, the scene's unit cubed.", limits::any, true},
                          names_of_volume_units});
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct MassParameters {
    static constexpr KindInfo info{
        "mass", "The mass of a phase, or of several together, is within limits. It needs their \"density\"."};
    std::vector<std::string> phase{};
    std::optional<double> at_least{}, at_most{};
    std::string unit = "kg";

    template <class V>
    static void parameters(V&& v) {
        using P = MassParameters;
        v(&P::phase, Parameter{"phase", "", "Name of the phase, or names of several."});
        v(&P::at_least, Parameter{"at_least", "", "The lower limit.", limits::non_negative, true});
        v(&P::at_most, Parameter{"at_most", "", "The upper limit.", limits::non_negative, true});
        v(&P::unit, ChoiceParameter{{"unit", "", "Unit of the limits.", limits::any, true}, names_of_mass_units});
    }
    MadeStatement made(const ExpectationContext&) const;
};

struct NoDeadNodesParameters {
    static constexpr KindInfo info{"no_dead_nodes",
                                   "Each node of the tree matters: without it, some point would have another label."};

    template <class V>
    static void parameters(V&&) {}
    MadeStatement made(const ExpectationContext&) const;
};

struct TightBoundsParameters {
    static constexpr KindInfo info{
        "tight_bounds",
        "The box that follows from the bounds of the tree's nodes is not much longer along any axis than the object."};
    double at_most = 2;

    template <class V>
    static void parameters(V&& v) {
        v(&TightBoundsParameters::at_most, Parameter{"at_most", "", "The factor, at least 1.", limits::positive, true});
    }
    MadeStatement made(const ExpectationContext&) const;
};

using ExpectationKinds =
    TypeList<PresentParameters, ConnectedParameters, ClosedParameters, ApartParameters, TouchingParameters,
             WallParameters, VolumeParameters, MassParameters, NoDeadNodesParameters, TightBoundsParameters>;

}  // namespace phasetree::tracer
