// The C99 interface, called in any order with any arguments. An input is a list of calls: a byte chooses one, the next
// bytes its arguments. Handles are retained and released as they like, freed ones and NULL are passed on purpose, and
// geometries outlive and are outlived by scenes. What the headers leave to the application is kept: a scene is traced
// only as it was committed, and a query has the context that its geometries were promised.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "fuzz/target.hpp"
#include "phasetree/phasetree_embree.h"

namespace phasetree::fuzz {

namespace {

constexpr const char* texts[] = {
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})",
    R"({"phases": {"a": {}, "b": {}}, "shapes": {"s": {"sphere": {"radius": 0.5}}}, "tree": {"under": [
        {"set": {"phase": "a", "of": {"box": {"size": [1, 1, 1]}}}}, {"set": {"phase": "b", "of": "s"}}]}})",
    R"({"phases": {"a": {}, "b": {}, "c": {}}, "tree": {"thin_shell": {"of": {"torus": {"major": 1, "minor": 0.3}},
        "shell": "a", "inside": "b", "half_thickness": 0.05}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"plane": {}}}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"height_map": {"file": "h", "size": [1, 1],
        "height": 0.5}}}}})",
    R"({"phases": {"a": {}}, "tree": {"set": {"phase": "b", "of": {"sphere": {"radius": 1}}}}})",
    "{",
    "",
};
constexpr const char* paths[] = {"/tree/set/of/sphere/radius",
                                 "/shapes/s/sphere/radius",
                                 "/tree",
                                 "",
                                 "/",
                                 "/nowhere",
                                 "/tree/under/0",
                                 "tree",
                                 "/~2",
                                 "/phases"};
constexpr const char* values[] = {"0.5", "2", "-1", "1e39", "{\"sphere\": {\"radius\": 1}}", "null", "[", "", "\"a\""};
constexpr float numbers[] = {0, 0.5f, -0.5f, 1, -1, 0.01f, 2, -3, 1e-3f, 100, 1e6f, -0.0f, 1e20f, 1e-30f};
constexpr float not_finite[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                -std::numeric_limits<float>::infinity()};

// What an input has left to say; zeros at its end.
class Choices {
  public:
    explicit Choices(Bytes bytes) : bytes_(bytes) {}
    bool is_over() const { return bytes_.empty(); }
    unsigned byte() {
        if (bytes_.empty()) return 0;
        const unsigned b = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return b;
    }
    unsigned below(unsigned n) { return n == 0 ? 0 : byte() % n; }
    bool rarely() { return byte() >= 240; }
    template <class List>
    auto of(const List& list) {
        return list[below(static_cast<unsigned>(std::size(list)))];
    }
    float number() {
        const unsigned b = byte();
        if (b < 120) return static_cast<float>(b) / 30 - 2;
        return b >= 248 ? of(not_finite) : of(numbers);
    }
    // The pointer, or now and then NULL.
    template <class T>
    T* or_null(T* p) {
        return rarely() ? nullptr : p;
    }

  private:
    Bytes bytes_;
};

void check(PhasetreeError error) {
    promised(error >= PHASETREE_ERROR_NONE && error <= PHASETREE_ERROR_EMBREE, "an error has a code that says which");
    const char* const message = phasetreeGetErrorMessage();
    promised(message != nullptr, "there is a message");
    if (error == PHASETREE_ERROR_NONE) return;
    const std::size_t length = std::strlen(message);
    promised(length > 0 && message[length - 1] != '\n', "an error has a message without a newline at its end");
}

template <class Handle>
struct Counted {
    Handle handle{};
    int references = 0;
};
struct Made : Counted<PhasetreeGeometry> {
    RTCGeometry embree = nullptr;  // retained
    bool wants_context = false, may_filter = true;
};
struct Stage {
    RTCScene scene = nullptr;
    std::vector<std::pair<unsigned, std::size_t>> attached;  // geomID, place in the list of geometries
    bool is_committed = false;
};

void reject_some(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        promised(phasetreeGetPhaseLeft(args->hit, args->N, i) != phasetreeGetPhaseEntered(args->hit, args->N, i),
                 "a crossing is a change of phase");
        if (phasetreeGetPhaseEntered(args->hit, args->N, i) == 1) args->valid[i] = 0;
    }
}

const char* read_image(void* user, const char*, PhasetreeImage image) {
    const auto kind = reinterpret_cast<std::uintptr_t>(user);
    if (kind == 0) return "there is no such file";
    if (kind == 1) return nullptr;
    if (phasetreeNewImageValues(image, 0, 5) || phasetreeNewImageValues(nullptr, 5, 5)) broken("sizes are checked");
    float* const heights = phasetreeNewImageValues(image, 3, 2);
    for (int i = 0; i < 6; ++i) heights[i] = static_cast<float>(i) / 6;
    return nullptr;
}

class Calls {
  public:
    explicit Calls(Bytes input) : c_(input) {
        static RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
        device_ = device;
        for (Stage& s : stages_) s.scene = rtcNewScene(device_);
    }
    ~Calls() {
        for (Stage& s : stages_) rtcReleaseScene(s.scene);
        for (Made& g : geometries_) {
            for (; g.references > 0; --g.references)
                promised(phasetreeReleaseGeometry(g.handle) == PHASETREE_ERROR_NONE, "a live handle is released");
            rtcReleaseGeometry(g.embree);
        }
        for (auto& t : trees_)
            for (; t.references > 0; --t.references)
                promised(phasetreeReleaseTree(t.handle) == PHASETREE_ERROR_NONE, "a live handle is released");
    }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void run() {
        using Call = void (Calls::*)();
        static constexpr Call calls[] = {
            &Calls::new_tree,       &Calls::new_edited_tree,
            &Calls::count_tree,     &Calls::ask_tree,
            &Calls::new_geometry,   &Calls::new_geometry,
            &Calls::count_geometry, &Calls::ask_geometry,
            &Calls::attach,         &Calls::detach,
            &Calls::commit,         &Calls::edit,
            &Calls::show,           &Calls::move,
            &Calls::filter,         &Calls::trace_one,
            &Calls::trace_packet,   &Calls::ask_point,
            &Calls::query_scene,    &Calls::call_back,
            &Calls::instance,
        };
        for (int i = 0; i < 40 && !c_.is_over(); ++i) (this->*c_.of(calls))();
    }

  private:
    unsigned version() { return c_.rarely() ? c_.byte() : PHASETREE_API_VERSION; }

    PhasetreeTree tree() {
        if (c_.rarely() || trees_.empty()) return reinterpret_cast<PhasetreeTree>(std::uintptr_t{c_.byte()} << 44 | 1);
        return trees_[c_.below(static_cast<unsigned>(trees_.size()))].handle;
    }
    PhasetreeGeometry geometry() {
        if (c_.rarely() || geometries_.empty()) return reinterpret_cast<PhasetreeGeometry>(std::uintptr_t{c_.byte()});
        return geometries_[c_.below(static_cast<unsigned>(geometries_.size()))].handle;
    }
    template <class List, class Handle>
    bool is_live(const List& list, Handle handle) const {
        for (const auto& one : list)
            if (one.handle == handle && one.references > 0) return true;
        return false;
    }
    bool is_live(PhasetreeTree handle) const { return is_live(trees_, handle); }
    bool is_live(PhasetreeGeometry handle) const { return is_live(geometries_, handle); }
    // A call with this handle: no other is served.
    template <class Handle>
    void check_with(Handle handle, PhasetreeError error) {
        check(error);
        if (!is_live(handle)) promised(error != PHASETREE_ERROR_NONE, "a handle that is not live is refused");
    }

    void new_tree() {
        const PhasetreeFileReader reader{c_.rarely() ? nullptr : read_image,
                                         reinterpret_cast<void*>(std::uintptr_t{c_.below(3)})};
        const PhasetreeFileReader* const with = c_.below(3) == 0 ? nullptr : &reader;
        const char* const name = c_.below(2) == 0 ? nullptr : "scene.json";
        const char* const text = c_.of(texts);
        const std::size_t length = std::strlen(text) - (c_.rarely() && *text != 0 ? 1 : 0);
        PhasetreeTree made = nullptr;
        PhasetreeTree* const to = c_.or_null(&made);
        const auto error = c_.rarely() ? phasetreeNewTreeFromFile(version(), c_.or_null("/nowhere"), with, to)
                                       : phasetreeNewTreeFromText(version(), c_.or_null(text), length, name, with, to);
        check(error);
        promised((error == PHASETREE_ERROR_NONE) == (made != nullptr), "a handle comes with success and only then");
        if (made) trees_.push_back({made, 1});
    }
    void new_edited_tree() {
        const PhasetreeTree of = tree();
        PhasetreeTree made = nullptr;
        const char* const path = c_.or_null(c_.of(paths));
        const char* const value = c_.or_null(c_.of(values));
        const auto error = phasetreeNewEditedTree(of, path, value, c_.or_null(&made));
        check_with(of, error);
        if (error == PHASETREE_ERROR_NONE) trees_.push_back({made, 1});
    }
    // Counts a reference more or less of a handle, live or not.
    template <class List, class Handle>
    void count(List& list, Handle handle, PhasetreeError error, int by) {
        check_with(handle, error);
        for (auto& one : list)
            if (one.handle == handle && one.references > 0) {
                promised(error == PHASETREE_ERROR_NONE, "a live handle is served");
                one.references += by;
                return;
            }
    }
    void count_tree() {
        const PhasetreeTree of = tree();
        const bool more = c_.below(3) == 0;
        count(trees_, of, more ? phasetreeRetainTree(of) : phasetreeReleaseTree(of), more ? 1 : -1);
    }
    void ask_tree() {
        const PhasetreeTree of = tree();
        unsigned phases = 0, phase = 0;
        const char* name = nullptr;
        RTCBounds bounds;
        check_with(of, phasetreeGetTreePhaseCount(of, c_.or_null(&phases)));
        check_with(of, phasetreeGetTreePhaseName(of, c_.below(5), c_.or_null(&name)));
        check_with(of, phasetreeGetTreePhaseByName(of, c_.or_null(name ? name : "b"), c_.or_null(&phase)));
        check_with(of, phasetreeGetTreeBounds(of, c_.or_null(&bounds)));
    }

    PhasetreeGeometryOptions options() {
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
    void new_geometry() {
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
        made.wants_context = (o.flags & PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT) != 0;
        made.may_filter = (o.flags & PHASETREE_GEOMETRY_FLAG_NO_FILTERS) == 0;
        point_query_ |= (o.flags & PHASETREE_GEOMETRY_FLAG_POINT_QUERY) != 0;
        geometries_.push_back(made);
    }
    void count_geometry() {
        const PhasetreeGeometry of = geometry();
        const bool more = c_.below(3) == 0;
        count(geometries_, of, more ? phasetreeRetainGeometry(of) : phasetreeReleaseGeometry(of), more ? 1 : -1);
    }
    void ask_geometry() {
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

    Stage& stage() { return stages_[c_.below(2)]; }
    void change() {
        for (Stage& s : stages_) s.is_committed = false;
    }
    void attach() {
        Stage& s = stage();
        if (geometries_.empty() || s.attached.size() > 6) return;
        const std::size_t i = c_.below(static_cast<unsigned>(geometries_.size()));
        s.attached.emplace_back(rtcAttachGeometry(s.scene, geometries_[i].embree), i);
        change();
    }
    void detach() {
        Stage& s = stage();
        if (s.attached.empty()) return;
        const std::size_t i = c_.below(static_cast<unsigned>(s.attached.size()));
        rtcDetachGeometry(s.scene, s.attached[i].first);
        s.attached.erase(s.attached.begin() + static_cast<std::ptrdiff_t>(i));
        change();
    }
    // The inner scene first: the outer one may have an instance of it.
    void commit() {
        for (const Made& g : geometries_) rtcCommitGeometry(g.embree);
        for (Stage& s : stages_) {
            rtcCommitScene(s.scene);
            s.is_committed = true;
        }
    }
    void instance() {
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

    void edit() {
        const PhasetreeGeometry of = geometry();
        const PhasetreeTree by = tree();
        const PhasetreeGeometryOptions o = options();
        const auto error = phasetreeSetGeometryTree(of, by, c_.below(8) == 0 ? nullptr : &o);
        check_with(of, error);
        if (!is_live(by)) promised(error != PHASETREE_ERROR_NONE, "a tree that is not live is refused");
        change();
    }
    void show() {
        const PhasetreeGeometry of = geometry();
        check_with(of, phasetreeSetGeometryShownPhases(of, c_.byte()));
    }
    void move() {
        const PhasetreeGeometry of = geometry();
        float m[24];
        for (float& v : m) v = c_.below(8) == 0 ? c_.number() : 0;
        m[0] += 1, m[4] += 1, m[8] += 1, m[12] += 1, m[16] += 2, m[20] += 1;
        const unsigned steps = c_.rarely() ? 130 + c_.byte() : c_.below(3);
        const float start = c_.below(3) == 0 ? c_.number() : 0, end = c_.below(3) == 0 ? c_.number() : 1;
        check_with(of, phasetreeSetGeometryMotion(of, steps > 2 ? m : c_.or_null(m), steps, start, end));
        change();
    }
    void filter() {
        if (geometries_.empty()) return;
        const Made& g = geometries_[c_.below(static_cast<unsigned>(geometries_.size()))];
        if (!g.may_filter) return;
        rtcSetGeometryIntersectFilterFunction(g.embree, c_.below(2) == 0 ? reject_some : nullptr);
        rtcSetGeometryOccludedFilterFunction(g.embree, c_.below(2) == 0 ? reject_some : nullptr);
        change();
    }

    bool wants_context() const {
        for (const Made& g : geometries_)
            if (g.wants_context) return true;
        return false;
    }
    // Numbers that Embree takes: Debian's ends the process with an assertion at others.
    float finite() {
        const float v = c_.number();
        return std::abs(v) < 1e18f ? v : 0;
    }
    RTCRay ray() {
        RTCRay r{};
        r.org_x = finite(), r.org_y = finite(), r.org_z = finite();
        r.dir_x = finite(), r.dir_y = finite(), r.dir_z = finite();
        r.tnear = c_.below(3) == 0 ? std::abs(finite()) : 0;
        r.tfar = c_.below(3) == 0 ? finite() : std::numeric_limits<float>::infinity();
        r.time = c_.below(3) == 0 ? static_cast<float>(c_.byte()) / 255 : 0;
        r.mask = ~0u;
        return r;
    }
    // A query's context; the phases that its one ray, or all of a packet, carry.
    struct Context {
        PhasetreeMedium media[2]{};
        PhasetreeRay rays[8]{};
        PhasetreeRayContext extended;
    };
    void prepare(Context& context) {
        phasetreeInitRayContext(&context.extended);
        for (PhasetreeMedium& m : context.media)
            m = {c_.below(4), c_.below(2) == 0 ? RTC_INVALID_GEOMETRY_ID : 0u,
                 c_.below(2) == 0 ? RTC_INVALID_GEOMETRY_ID : 0u,
                 c_.rarely()   ? PHASETREE_UNKNOWN_PHASE
                 : c_.rarely() ? c_.byte()
                               : c_.below(4)};
        for (PhasetreeRay& r : context.rays) {
            r.media = context.media;
            r.mediumCount = c_.below(3);
        }
        const unsigned carried = c_.below(4);
        context.extended.rays = carried == 0 ? nullptr : context.rays;
        context.extended.rayCount = carried == 0 ? 0 : carried == 1 ? 1 : 8;
        if (c_.rarely()) context.extended.filter = reject_some;
    }
#if RTC_VERSION_MAJOR >= 4
    template <class F>
    static void with(PhasetreeRayContext& context, F&& f) {
        RTCIntersectArguments a;
        rtcInitIntersectArguments(&a);
        a.context = &context.context;
        f(&a);
    }
    template <class F>
    static void with_occluded(PhasetreeRayContext& context, F&& f) {
        RTCOccludedArguments a;
        rtcInitOccludedArguments(&a);
        a.context = &context.context;
        f(&a);
    }
    static void intersect(RTCScene s, PhasetreeRayContext& context, RTCRayHit& r) {
        with(context, [&](auto* a) { rtcIntersect1(s, &r, a); });
    }
    static void occlude(RTCScene s, PhasetreeRayContext& context, RTCRay& r) {
        with_occluded(context, [&](auto* a) { rtcOccluded1(s, &r, a); });
    }
    static void intersect(RTCScene s, PhasetreeRayContext& context, const int* valid, RTCRayHit8& r) {
        with(context, [&](auto* a) { rtcIntersect8(valid, s, &r, a); });
    }
#else
    static void intersect(RTCScene s, PhasetreeRayContext& context, RTCRayHit& r) {
        rtcIntersect1(s, &context.context, &r);
    }
    static void occlude(RTCScene s, PhasetreeRayContext& context, RTCRay& r) {
        rtcOccluded1(s, &context.context, &r);
    }
    static void intersect(RTCScene s, PhasetreeRayContext& context, const int* valid, RTCRayHit8& r) {
        rtcIntersect8(valid, s, &context.context, &r);
    }
#endif

    void trace_one() {
        const Stage& s = stage();
        if (!s.is_committed) return;
        Context context;
        prepare(context);
        RTCRayHit r{};
        r.ray = ray();
        r.hit.geomID = r.hit.primID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        const float far = r.ray.tfar;
        intersect(s.scene, context.extended, r);
        if (r.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            promised(r.ray.tfar <= far, "a hit is before the ray's end");
            promised(r.hit.u >= 0 && r.hit.u < PHASETREE_MAX_PHASES && r.hit.v >= 0 && r.hit.v < PHASETREE_MAX_PHASES,
                     "a hit has phases");
            promised(r.hit.u != r.hit.v, "a hit is a change of phase");
        }
        PhasetreeHit decoded;
        const float identity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
        const PhasetreeGeometry of = geometry();
        check_with(of,
                   phasetreeDecodeHit(of, c_.or_null(&r), c_.below(2) == 0 ? nullptr : identity, c_.or_null(&decoded)));
        RTCRay shadow = ray();
        occlude(s.scene, context.extended, shadow);
    }
    void trace_packet() {
        const Stage& s = stage();
        if (!s.is_committed) return;
        Context context;
        prepare(context);
        RTCRayHit8 packet{};
        alignas(32) int valid[8];
        for (unsigned i = 0; i < 8; ++i) {
            const RTCRay r = ray();
            packet.ray.org_x[i] = r.org_x, packet.ray.org_y[i] = r.org_y, packet.ray.org_z[i] = r.org_z;
            packet.ray.dir_x[i] = r.dir_x, packet.ray.dir_y[i] = r.dir_y, packet.ray.dir_z[i] = r.dir_z;
            packet.ray.tnear[i] = r.tnear, packet.ray.tfar[i] = r.tfar, packet.ray.time[i] = r.time;
            packet.ray.mask[i] = ~0u, packet.ray.id[i] = c_.below(9);
            packet.hit.geomID[i] = packet.hit.primID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            valid[i] = c_.below(4) == 0 ? 0 : -1;
        }
        intersect(s.scene, context.extended, valid, packet);
        for (unsigned i = 0; i < 8; ++i)
            if (valid[i] == 0)
                promised(packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID, "lanes that are inactive hit nothing");
    }

    void ask_point() {
        const PhasetreeGeometry of = geometry();
        const float p[3] = {c_.number(), c_.number(), c_.number()};
        const float time = c_.number();
        unsigned phase = 0;
        float radius = 0, distances[PHASETREE_MAX_PHASES];
        PhasetreeClosest closest;
        const auto error = phasetreeGetPhase(of, c_.or_null(p), time, c_.or_null(&phase), c_.or_null(&radius));
        check_with(of, error);
        if (error == PHASETREE_ERROR_NONE)
            promised(phase < PHASETREE_MAX_PHASES && !(radius < 0), "a point has a phase and an empty ball");
        check_with(of, phasetreeGetDistances(of, c_.or_null(p), time, c_.rarely() ? nullptr : distances));
        check_with(of, phasetreeFindClosestInterface(of, c_.or_null(p), time, c_.number(),
                                                     c_.rarely() ? c_.number() : 0.5f, c_.or_null(&closest)));
    }
    void query_scene() {
        const Stage& s = stage();
        if (!s.is_committed) return;
        std::vector<PhasetreePointQueryGeometry> listed;
        for (const auto& [id, place] : s.attached)
            listed.push_back({id, RTC_INVALID_GEOMETRY_ID, geometries_[place].handle});
        PhasetreePointQuery own{};
        own.apiVersion = c_.rarely() ? 7 : PHASETREE_API_VERSION;
        own.geometries = listed.data();
        own.geometryCount = static_cast<unsigned>(listed.size());
        own.tolerance = c_.rarely() ? c_.number() : 0.5f;
        RTCPointQuery query{c_.number(), c_.number(), c_.number(), 0, std::abs(c_.number())};
        if (!(query.radius >= 0) || !std::isfinite(query.x + query.y + query.z)) return;
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(s.scene, &query, &context, point_query_ ? nullptr : phasetreePointQueryFunction, &own);
    }
    // Handles that are not live have empty bounds.
    void call_back() {
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

    Choices c_;
    RTCDevice device_ = nullptr;
    std::vector<Counted<PhasetreeTree>> trees_;
    std::vector<Made> geometries_;
    Stage stages_[2];
    unsigned questions_ = 0;
    bool has_instance_ = false, point_query_ = false;
};

}  // namespace

void run_calls(Bytes input) {
    Calls(input).run();
}

}  // namespace phasetree::fuzz
