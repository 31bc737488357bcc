// Scenes, of which the second may have an instance of the first, get and lose geometries.
#include "fuzz/calls/calls.hpp"

namespace phasetree::fuzz {

void Calls::change() {
    for (Stage& s : stages_) s.is_committed = false;
}

void Calls::attach() {
    Stage& s = stage();
    if (geometries_.empty() || s.attached.size() > 6) return;
    const std::size_t i = c_.below(static_cast<unsigned>(geometries_.size()));
    s.attached.emplace_back(rtcAttachGeometry(s.scene, geometries_[i].embree), i);
    change();
}

void Calls::detach() {
    Stage& s = stage();
    if (s.attached.empty()) return;
    const std::size_t i = c_.below(static_cast<unsigned>(s.attached.size()));
    rtcDetachGeometry(s.scene, s.attached[i].first);
    s.attached.erase(s.attached.begin() + static_cast<std::ptrdiff_t>(i));
    change();
}

void Calls::commit() {
    for (const Made& g : geometries_) rtcCommitGeometry(g.embree);
    for (Stage& s : stages_) {
        rtcCommitScene(s.scene);
        s.is_committed = true;
    }
}

void Calls::instance() {
    if (has_instance_) return;
    const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, stages_[0].scene);
    rtcSetGeometryTimeStepCount(instance, 1);
    const float s = c_.below(2) == 0 ? 1.0f : 0.25f;
    const float m[12] = {s, 0, 0, 0, -s, 0, 0, 0, 2 * s, 0.5f, 0, 0};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m);
    rtcCommitGeometry(instance);
    rtcAttachGeometry(stages_[1].scene, instance);
    rtcReleaseGeometry(instance);
    has_instance_ = true;
    change();
}

}  // namespace phasetree::fuzz
