// Geometries are created from trees, reference-counted, queried, edited, moved, and their callbacks are called as
// Embree would.
#include <cstdint>

#include "fuzz/calls/calls.hpp"

namespace phasetree::fuzz {

void reject_some(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        promised(phasetreeGetHitFrom(args->hit, args->N, i) != phasetreeGetHitTo(args->hit, args->N, i),
                 "a crossing is a change of phase");
        if (phasetreeGetHitTo(args->hit, args->N, i) == 1) args->valid[i] = 0;
    }
}

PhasetreeGeometryOptions Calls::options() {
    PhasetreeGeometryOptions o;
    phasetreeInitGeometryOptions(&o);
    o.flags = c_.rarely() ? c_.byte() : c_.below(16);
    constexpr float resolutions[] = {0, 0, 1e-3f, 0.02f, -1, 1e10f};
    o.resolution = c_.of(resolutions);
    o.buildQuality = c_.rarely() ? c_.byte() : static_cast<unsigned>(RTC_BUILD_QUALITY_LOW);
    o.cellDivisions = c_.rarely() ? c_.byte() : 1 + c_.below(5);
    if (c_.rarely()) o.shownPhases = c_.byte();
    if (c_.below(4) == 0) o.opaquePhases = c_.byte() & (c_.rarely() ? 0xffu : 0xeu);
    questions_ = c_.rarely() ? c_.below(20) : 400;
    o.cancelled = [](void* left) { return --*static_cast<unsigned*>(left) == 0; };
    o.cancelledUserPtr = &questions_;
    return o;
}

void Calls::new_geometry() {
    if (geometries_.size() >= 8) return;
    const PhasetreeTree of = tree();
    const PhasetreeGeometryOptions o = options();
    const RTCDevice device = c_.or_null(device_);
    Made made;
    const auto error = phasetreeNewGeometry(version(), device, of, &o, c_.or_null(&made.handle));
    check_with(of, error);
    if (error != PHASETREE_ERROR_NONE) return;
    made.references = 1;
    promised(phasetreeGetEmbreeGeometry(made.handle, &made.embree) == PHASETREE_ERROR_NONE, "it has a geometry");
    rtcRetainGeometry(made.embree);
    rtcCommitGeometry(made.embree);
    made.may_filter = (o.flags & PHASETREE_GEOMETRY_FLAG_NO_FILTERS) == 0;
    point_query_ |= (o.flags & PHASETREE_GEOMETRY_FLAG_POINT_QUERY) != 0;
    geometries_.push_back(made);
}

void Calls::count_geometry() {
    const PhasetreeGeometry of = geometry();
    const bool more = c_.below(3) == 0;
    count(geometries_, of, more ? phasetreeRetainGeometry(of) : phasetreeReleaseGeometry(of), more ? 1 : -1);
}

void Calls::ask_geometry() {
    const PhasetreeGeometry of = geometry();
    RTCGeometry embree = nullptr;
    void* user = nullptr;
    PhasetreeGeometryStatistics statistics;
    check_with(of, phasetreeGetEmbreeGeometry(of, c_.or_null(&embree)));
    check_with(of, phasetreeSetGeometryUserData(of, this));
    const auto error = phasetreeGetGeometryUserData(of, c_.or_null(&user));
    check_with(of, error);
    if (error == PHASETREE_ERROR_NONE) promised(user == this, "the application's pointer is kept");
    check_with(of, phasetreeGetGeometryStatistics(of, c_.or_null(&statistics)));
    if (geometries_.empty()) return;
    const Made& one = geometries_[c_.below(static_cast<unsigned>(geometries_.size()))];
    PhasetreeGeometry found = nullptr;
    const auto asked = phasetreeGetGeometryFromEmbree(c_.or_null(one.embree), c_.or_null(&found));
    check(asked);
    if (asked == PHASETREE_ERROR_NONE) promised(found == one.handle && one.references > 0, "the handle is found");
}

void Calls::edit() {
    const PhasetreeGeometry of = geometry();
    const PhasetreeTree by = tree();
    const PhasetreeGeometryOptions o = options();
    const auto error = phasetreeSetGeometryTree(of, by, c_.below(8) == 0 ? nullptr : &o);
    check_with(of, error);
    if (!is_live(by)) promised(error != PHASETREE_ERROR_NONE, "a tree that is not live is rejected");
    change();
}

void Calls::show() {
    const PhasetreeGeometry of = geometry();
    check_with(of, phasetreeSetGeometryShownPhases(of, c_.byte()));
}

void Calls::move() {
    const PhasetreeGeometry of = geometry();
    float m[24];
    for (float& v : m) v = c_.below(8) == 0 ? c_.number() : 0;
    m[0] += 1, m[4] += 1, m[8] += 1, m[12] += 1, m[16] += 2, m[20] += 1;
    const unsigned steps = c_.rarely() ? 130 + c_.byte() : c_.below(3);
    const float start = c_.below(3) == 0 ? c_.number() : 0, end = c_.below(3) == 0 ? c_.number() : 1;
    check_with(of, phasetreeSetGeometryMotion(of, steps > 2 ? m : c_.or_null(m), steps, start, end));
    change();
}

void Calls::filter() {
    if (geometries_.empty()) return;
    const Made& g = geometries_[c_.below(static_cast<unsigned>(geometries_.size()))];
    if (!g.may_filter) return;
    rtcSetGeometryIntersectFilterFunction(g.embree, c_.below(2) == 0 ? reject_some : nullptr);
    rtcSetGeometryOccludedFilterFunction(g.embree, c_.below(2) == 0 ? reject_some : nullptr);
    change();
}

void Calls::call_back() {
    const PhasetreeGeometry of = geometry();
    RTCBounds box{};
    RTCBoundsFunctionArguments a{};
    a.geometryUserPtr = of;
    a.bounds_o = &box;
    if (c_.below(2) == 0)
        phasetreeBoundsFunction(&a);
    else
        phasetreeGetPrimitiveBounds(of, &a);
    if (!is_live(of)) promised(!(box.lower_x <= box.upper_x), "what is not live has empty bounds");
}

}  // namespace phasetree::fuzz
