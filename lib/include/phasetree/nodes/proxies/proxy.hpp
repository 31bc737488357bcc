#pragma once

#include "phasetree/nodes/proxies/guard.hpp"

namespace phasetree {

/// Two bounding volumes (guard.hpp): {b < 0} with b = g − e contains the child's solid; {−c < 0} with c = g + e, which
/// is everything but the proxy's core, contains the complement of that solid. If the child's surface lies between {g =
/// −e} and {g = e}, the zero set is the child's. Otherwise, parts of the child outside {g = e} are cut off, and gaps
/// inside {g = −e} are filled.
template <class Child>
struct Proxy {
    static constexpr NodeInfo info{"proxy", "4.1, 7.3",
                                   "min(c, max(h, −2m − c)),  h = max(b, min(f, 2m − b)),  b = g − e,  c = g + e",
                                   "A field or an object with a proxy, a simpler field g near it, which replaces it "
                                   "away from the surface, outside and inside. Parts more than e outside the proxy are "
                                   "cut off, and gaps more than e inside it are filled."};
    Child of{};
    Field proxy{};
    float error = 0.1f;
    float margin = 0.1f;
    PhaseSet inside{};

    template <class V>
    static void parameters(V&& v) {
        v(&Proxy::of, Parameter{"of", "", "The field or object to replace."});
        v(&Proxy::proxy, Parameter{"proxy", "", "The simpler field, g."});
        v(&Proxy::error, Parameter{"error", "m", "Maximum distance e between the two surfaces.", limits::non_negative});
        v(&Proxy::margin, detail::guard_margin);
        v(&Proxy::inside,
          Parameter{"inside", "",
                    "For an object: the phase that fills the part of the proxy deeper than e. By default, the "
                    "proxy is used only outside.",
                    limits::any, true});
    }
    void prepare() const {
        if (inside.size() > 1) throw ModelError("proxy: \"inside\" must be one phase");
        if (inside.contains(vacuum)) throw ModelError("proxy: \"inside\" must be a phase other than the vacuum");
        if (std::is_same_v<Child, Field> && !inside.empty())
            throw ModelError("proxy: \"inside\" applies only to objects, but this is a plain field");
    }
    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        using T = typename D::Scalar;
        const T g = d.field(proxy, p);
        const T outside = g - error, core = -(g + error);
        if constexpr (std::is_same_v<Child, Field>) {
            return -detail::guarded_by(core, margin, [&]() -> T {
                return -detail::guarded_by(outside, margin, [&]() -> T { return d.field(of, p); });
            });
        } else {
            const auto within = [&] {
                return detail::object_guarded_by(outside, margin, phasetree::phases(of), vacuum.index,
                                                 [&] { return d.phases(of, p); });
            };
            if (inside.empty()) return within();
            return detail::object_guarded_by(core, margin, phasetree::phases(of) | PhaseSet::of(vacuum), filling(),
                                             within);
        }
    }
    PhaseSet phases() const requires(std::is_same_v<Child, Phased>) {
        return phasetree::phases(of) | PhaseSet::of(vacuum) | inside;
    }
    /// Inside the core everything is at most g + e; around it, the bounds are those of a bounding volume.
    Bounds bounds(BoundsQuery& q, float level) const {
        const auto around = [&] { return q(proxy, level + error); };
        const Bounds object = level >= margin ? around() : q.cut([&] { return intersect(q(of, level), around()); });
        if (std::is_same_v<Child, Phased> && inside.empty()) return object;
        return unite(object, q(proxy, level - error));
    }

  private:
    int filling() const { return std::countr_zero(inside.bits); }
};

struct FieldProxy : Proxy<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedProxy : Proxy<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
